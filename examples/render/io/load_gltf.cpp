#include "io/load_gltf.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <lightcuts/core/invalid_input.hpp>
#include <lightcuts/core/vector.hpp>

#include "io/escape.hpp"
#include "io/gltf_document.hpp"
#include "io/gltf_materials.hpp"
#include "io/gltf_mesh.hpp"
#include "io/gltf_nodes.hpp"
#include "io/gltf_pose.hpp"
#include "io/text_file.hpp"
#include "io/world_origin.hpp"

namespace render {
namespace {

using lightcuts::invalid_input;

class GltfReader {
public:
    GltfReader(const std::filesystem::path& path, const FileSource& files)
        : document_(path, files), materials_(document_, scene_), meshes_(document_, materials_, scene_),
          nodes_(document_, scene_.left_out), skins_(document_, nodes_) {
        scene_.name = path.string();
    }

    Scene read() {
        for (const std::size_t node : nodes_.shown()) {
            const JsonObject json = nodes_.json(node);
            if (const auto mesh = json.index("mesh")) add_mesh(node, json, *mesh);
        }
        set_positions(scene_, positions_);
        drop_absent_attributes();
        for (const std::size_t node : nodes_.shown()) {
            const JsonObject json = nodes_.json(node);
            if (const auto camera = json.index("camera")) add_camera(node, json, *camera);
            if (const auto light = json.extension("KHR_lights_punctual")) {
                if (light->has("light")) add_light(node, json, light->needed("light"));
            }
        }
        name_cameras_apart();
        document_.note_extensions(scene_.left_out);
        materials_.note_unused_images();
        return std::move(scene_);
    }

private:
    // ---- meshes

    void add_mesh(std::size_t node, const JsonObject& json, std::size_t index) {
        const GltfMesh& mesh = meshes_.mesh(index);
        const std::vector<double>& weights = nodes_.weights(node).empty() ? mesh.weights : nodes_.weights(node);
        const auto skin = json.index("skin");
        const std::vector<glm::dmat4> instances = instances_of(document_, json);
        for (const GltfPrimitive& stored : mesh.primitives) {
            const bool is_morphed = !stored.morphs.empty() && !weights.empty();
            const std::optional<GltfPrimitive> posed = is_morphed ? std::optional(morphed(stored, weights))
                                                                  : std::nullopt;
            const GltfPrimitive& primitive = posed ? *posed : stored;
            if (skin && (!primitive.bones.empty() || !primitive.bones_problem.empty())) {
                // A skinned mesh ignores where its own node is.
                const std::vector<glm::dmat4> to_world = skins_.to_world(*skin, primitive);
                add_primitive(primitive, [&](std::size_t v) -> const glm::dmat4& { return to_world[v]; });
                continue;
            }
            for (const glm::dmat4& instance : instances) {
                const glm::dmat4 to_world = nodes_.to_world(node) * instance;
                add_primitive(primitive, [&](std::size_t) -> const glm::dmat4& { return to_world; });
            }
        }
    }

    /// `to_world(v)`: transform of vertex v.
    template <class ToWorld>
    void add_primitive(const GltfPrimitive& primitive, const ToWorld& to_world) {
        const std::size_t count = primitive.positions.size();
        if (positions_.size() > std::numeric_limits<std::uint32_t>::max() - count) {
            throw invalid_input("more than 2^32 vertices; split the scene");
        }
        const auto first = static_cast<std::uint32_t>(positions_.size());
        const glm::dmat4* transform = nullptr;
        glm::dmat3 linear(1.0);
        glm::dmat3 normal_matrix(1.0);
        for (std::size_t v = 0; v < count; ++v) {
            if (const glm::dmat4* own = &to_world(v); own != transform) {
                transform = own;
                linear = glm::dmat3(*transform);
                const bool invertible = glm::determinant(linear) != 0.0;
                normal_matrix = invertible ? glm::transpose(glm::inverse(linear)) : glm::dmat3(1.0);
            }
            positions_.emplace_back(*transform * glm::dvec4(primitive.positions[v], 1.0));
            scene_.normals.push_back(primitive.normals.empty() ? glm::vec3(0.0f)
                                                               : unit(normal_matrix * primitive.normals[v]));
            scene_.colors.push_back(primitive.colors.empty() ? glm::vec4(1.0f) : glm::vec4(primitive.colors[v]));
            scene_.tangents.push_back(primitive.tangents.empty() ? glm::vec4(0.0f)
                                                                 : tangent(linear, primitive.tangents[v]));
        }
        any_normal_ = any_normal_ || !primitive.normals.empty();
        any_color_ = any_color_ || !primitive.colors.empty();
        any_tangent_ = any_tangent_ || !primitive.tangents.empty();
        add_uvs(primitive, first);
        for (const glm::uvec3& corners : primitive.triangles) {
            glm::uvec3 triangle = corners + first;
            // A mirroring transform turns the winding.
            if (glm::determinant(glm::dmat3(to_world(corners.x))) < 0.0) std::swap(triangle.y, triangle.z);
            scene_.triangles.push_back(triangle);
            scene_.triangle_material.push_back(primitive.material);
        }
    }

    static glm::vec3 unit(const glm::dvec3& v) {
        const double length = glm::length(v);
        return glm::vec3(length > 0.0 ? v / length : v);
    }

    static glm::vec4 tangent(const glm::dmat3& linear, const glm::dvec4& v) {
        const double side = glm::determinant(linear) < 0.0 ? -v.w : v.w;
        return {unit(linear * glm::dvec3(v)), side < 0.0 ? -1.0f : 1.0f};
    }

    void add_uvs(const GltfPrimitive& primitive, std::size_t first) {
        const std::vector<std::size_t>& numbers = materials_.uv_sets();
        scene_.uv_sets.resize(numbers.size());
        for (std::size_t set = 0; set < numbers.size(); ++set) {
            std::vector<glm::vec2>& uvs = scene_.uv_sets[set];
            uvs.resize(first, glm::vec2(0.0f));
            const auto own = primitive.uvs.find(numbers[set]);
            if (own != primitive.uvs.end()) uvs.insert(uvs.end(), own->second.begin(), own->second.end());
            uvs.resize(positions_.size(), glm::vec2(0.0f));
        }
    }

    void drop_absent_attributes() {
        if (!any_normal_) scene_.normals.clear();
        if (!any_color_) scene_.colors.clear();
        if (!any_tangent_) scene_.tangents.clear();
    }

    // ---- cameras and lights

    void add_camera(std::size_t node, const JsonObject& json, std::size_t index) {
        const JsonObject source = document_.element("cameras", index, "camera");
        const std::string own_name = source.text("name");
        const std::string node_name = json.text("name");
        Camera camera;
        camera.name = !own_name.empty()    ? own_name
                      : !node_name.empty() ? node_name
                                           : "camera " + std::to_string(scene_.cameras.size());
        camera.other_name = node_name;
        camera.eye = glm::dvec3(nodes_.to_world(node)[3]);
        const glm::dvec3 forward = nodes_.forward(node);
        if (forward == glm::dvec3(0.0)) source.fail("its node's transform leaves no direction; correct it");
        camera.target = camera.eye + forward * std::max(1.0, glm::length(camera.eye));
        camera.up = unit(glm::dvec3(nodes_.to_world(node)[1]));
        const std::string type = source.text("type");
        if (type == "perspective") {
            const JsonObject lens = source.object("perspective");
            camera.vertical_fov = static_cast<float>(lens.number("yfov", 0.0) * 180.0 / std::numbers::pi);
        } else if (type == "orthographic") {
            camera.height = 2.0 * source.object("orthographic").number("ymag", 0.0);
            if (!(camera.height > 0.0)) source.fail("orthographic: ymag is not a number above 0; correct it");
        } else {
            source.refuse("type", "perspective or orthographic");
        }
        scene_.cameras.push_back(camera);
    }

    /// Cameras that share a name are told apart by their nodes', or by numbers.
    void name_cameras_apart() {
        std::map<std::string, int> uses;
        for (const Camera& camera : scene_.cameras) ++uses[camera.name];
        for (Camera& camera : scene_.cameras) {
            if (uses[camera.name] > 1 && !camera.other_name.empty()) std::swap(camera.name, camera.other_name);
        }
        std::map<std::string, int> seen;
        for (Camera& camera : scene_.cameras) {
            const int times = ++seen[camera.name];
            if (times > 1) camera.name += " " + std::to_string(times);
        }
    }

    void add_light(std::size_t node, const JsonObject& json, std::size_t index) {
        const auto extension = document_.root().extension("KHR_lights_punctual");
        static const nlohmann::json nothing = nlohmann::json::array();
        const nlohmann::json& lights = extension ? extension->list("lights") : nothing;
        if (index >= lights.size()) {
            throw invalid_input("light " + std::to_string(index) + " does not exist; the file is damaged");
        }
        const std::string own_name = JsonObject(lights[index], "light " + std::to_string(index)).text("name");
        const std::string name = own_name.empty() ? json.text("name") : own_name;
        const JsonObject source(lights[index],
                                name.empty() ? "light " + std::to_string(index) : "light '" + excerpt(name) + "'");
        const float brightness = source.number_in("intensity", 1.0f, 0.0f, std::numeric_limits<float>::max());
        const glm::vec3 intensity = source.color("color", glm::vec3(1.0f)) * brightness;
        if (!lightcuts::is_finite(intensity)) source.fail("its intensity times its color is too large; correct it");
        const glm::vec3 position(glm::dvec3(nodes_.to_world(node)[3]) - scene_.origin);
        if (source.has("range")) {
            leave_out(scene_.left_out, "the range of lights", "light falls off with the square of the distance");
        }
        const std::string type = source.text("type");
        if (type == "point") {
            add_point_light(source, position, intensity);
        } else if (type == "directional") {
            scene_.directional.push_back({direction(source, node), intensity});
        } else if (type == "spot") {
            const JsonObject cone = source.object("spot");
            constexpr auto right_angle = static_cast<float>(std::numbers::pi / 2);
            const double wide = static_cast<double>(
                cone.number_in("outerConeAngle", right_angle / 2, 0.0f, right_angle));
            const double narrow = static_cast<double>(cone.number_in("innerConeAngle", 0.0f, 0.0f, right_angle));
            // The least width of the ramp between the cones is the extension's own.
            const double outer = std::cos(wide);
            const double inner = std::max(std::cos(narrow), outer + 0.001);
            scene_.spots.push_back(
                {position, direction(source, node), intensity, {static_cast<float>(inner), static_cast<float>(outer)}});
        } else {
            source.fail("is of the unknown type '" + excerpt(type) + "'; use point, spot or directional");
        }
    }

    glm::vec3 direction(const JsonObject& light, std::size_t node) const {
        const glm::dvec3 forward = nodes_.forward(node);
        if (forward == glm::dvec3(0.0)) light.fail("its node's transform leaves no direction; correct it");
        return glm::vec3(forward);
    }

    /// A point light that its author gave a size is a sphere. As all of a light, the size ignores the nodes' scale.
    void add_point_light(const JsonObject& source, const glm::vec3& position, const glm::vec3& intensity) {
        float radius = 0.0f;
        if (const nlohmann::json* extras = source.find("extras")) {
            if (extras->is_object() && extras->contains("radius")) {
                const nlohmann::json& value = (*extras)["radius"];
                radius = value.is_number() ? static_cast<float>(value.get<double>()) : -1.0f;
                if (!(radius >= 0.0f && std::isfinite(radius))) {
                    source.fail("the radius in its extras is no number of at least 0; correct or remove it");
                }
            } else if (!extras->is_object()) {
                leave_out(scene_.left_out, "the extras of " + source.name(), "they are no object with a radius");
            }
        }
        if (radius > 0.0f) {
            scene_.spheres.push_back({position, radius, intensity});
        } else {
            scene_.omni.push_back({position, intensity});
        }
    }

    Scene scene_;
    GltfDocument document_;
    GltfMaterials materials_;
    GltfMeshes meshes_;
    GltfNodes nodes_;
    GltfSkins skins_;
    std::vector<glm::dvec3> positions_;  ///< in world coordinates
    bool any_normal_ = false;
    bool any_color_ = false;
    bool any_tangent_ = false;
};

}  // namespace

Scene load_gltf(const std::filesystem::path& path, const FileSource& files) {
    try {
        return GltfReader(path, files).read();
    } catch (const invalid_input& problem) {
        const std::string message = problem.what();
        // That of the file itself names it already.
        throw message.starts_with(path.string() + ": ") ? problem : invalid_input(path.string() + ": " + message);
    }
}

}  // namespace render
