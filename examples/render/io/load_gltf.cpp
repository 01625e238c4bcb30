#include "io/load_gltf.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <span>
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
#include "motion.hpp"

namespace render {
namespace {

using lightcuts::invalid_input;

class GltfReader {
public:
    GltfReader(const std::filesystem::path& path, const FileSource& files, const Shutter& shutter)
        : shutter_(shutter), document_(path, files), materials_(document_, scene_),
          meshes_(document_, materials_, scene_), nodes_(document_, shutter, scene_.left_out),
          skins_(document_, nodes_) {
        scene_.name = path.string();
    }

    Scene read() {
        for (const std::size_t node : nodes_.shown()) {
            const JsonObject json = nodes_.json(node);
            if (const auto mesh = json.index("mesh")) add_mesh(node, json, *mesh);
        }
        set_positions(scene_, positions_);
        drop_absent_attributes();
        for (const Moved& moved : moved_) move(moved);
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

    /// Vertices of the scene that an animation moves.
    struct Moved {
        std::uint32_t first = 0;
        std::size_t node = 0;
        const GltfMesh* mesh = nullptr;
        const GltfPrimitive* primitive = nullptr;
        std::optional<std::size_t> skin;
        glm::dmat4 instance{1.0};
        std::uint32_t parts = 0;  ///< of the time for which the shutter is open, at least
    };

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
            Moved moved;
            moved.node = node;
            moved.mesh = &mesh;
            moved.primitive = &stored;
            if (skin && (!primitive.bones.empty() || !primitive.bones_problem.empty())) {
                // A skinned mesh ignores where its own node is.
                const std::vector<glm::dmat4> to_world = skins_.to_world(*skin, primitive);
                moved.skin = skin;
                moved.parts = std::max(skins_.least_parts(*skin), nodes_.least_parts(node));
                add_primitive(primitive, moved, to_world);
                continue;
            }
            for (const glm::dmat4& instance : instances) {
                const glm::dmat4 to_world = nodes_.to_world(node) * instance;
                moved.instance = instance;
                moved.parts = nodes_.least_parts(node);
                add_primitive(primitive, moved, std::span(&to_world, 1));
            }
        }
    }

    /// `to_world`: of all vertices, or of each.
    void add_primitive(const GltfPrimitive& primitive, Moved moved, std::span<const glm::dmat4> to_world) {
        const std::size_t count = primitive.positions.size();
        if (positions_.size() > std::numeric_limits<std::uint32_t>::max() - count) {
            throw invalid_input("more than 2^32 vertices; split the scene");
        }
        const auto first = static_cast<std::uint32_t>(positions_.size());
        const PosedVertices posed = posed_vertices(primitive, to_world);
        positions_.insert(positions_.end(), posed.positions.begin(), posed.positions.end());
        scene_.normals.insert(scene_.normals.end(), posed.normals.begin(), posed.normals.end());
        scene_.tangents.insert(scene_.tangents.end(), posed.tangents.begin(), posed.tangents.end());
        for (std::size_t v = 0; v < count; ++v) {
            scene_.colors.push_back(primitive.colors.empty() ? glm::vec4(1.0f) : glm::vec4(primitive.colors[v]));
        }
        any_normal_ = any_normal_ || !primitive.normals.empty();
        any_color_ = any_color_ || !primitive.colors.empty();
        any_tangent_ = any_tangent_ || !primitive.tangents.empty();
        add_uvs(primitive, first);
        for (const glm::uvec3& corners : primitive.triangles) {
            glm::uvec3 triangle = corners + first;
            // A mirroring transform turns the winding.
            const glm::dmat4& transform = to_world[to_world.size() > 1 ? corners.x : 0];
            if (glm::determinant(glm::dmat3(transform)) < 0.0) std::swap(triangle.y, triangle.z);
            scene_.triangles.push_back(triangle);
            scene_.triangle_material.push_back(primitive.material);
        }
        moved.first = first;
        if (!shutter_.is_moment() && moved.parts > 0) moved_.push_back(moved);
    }

    /// Lets vertices of the scene, which has all of its positions, move as the animation says.
    void move(const Moved& moved) {
        const auto count = static_cast<std::uint32_t>(moved.primitive->positions.size());
        // Between two keys nothing turns by more than half a turn: a quarter is seen as such.
        add_motion(scene_, moved.first, count, 2 * moved.parts, [&](double time) { return frame_of(moved, time); });
    }

    VertexFrame frame_of(const Moved& moved, double time) const {
        const double second = shutter_.second_at(time);
        const std::vector<double> own = nodes_.weights(moved.node, second);
        const std::vector<double>& weights = own.empty() ? moved.mesh->weights : own;
        const GltfPrimitive& stored = *moved.primitive;
        const bool is_morphed = !stored.morphs.empty() && !weights.empty();
        const std::optional<GltfPrimitive> changed = is_morphed ? std::optional(morphed(stored, weights))
                                                                : std::nullopt;
        const GltfPrimitive& primitive = changed ? *changed : stored;
        std::vector<glm::dmat4> to_world;
        if (moved.skin) {
            to_world = skins_.to_world(*moved.skin, primitive, second);
        } else {
            to_world = {nodes_.pose(moved.node, second).to_world * moved.instance};
        }
        PosedVertices posed = posed_vertices(primitive, to_world);
        VertexFrame frame;
        for (const glm::dvec3& p : posed.positions) frame.positions.emplace_back(p - scene_.origin);
        if (any_normal_) frame.normals = std::move(posed.normals);
        if (any_tangent_) frame.tangents = std::move(posed.tangents);
        return frame;
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
        const CameraPose opening = camera_pose({nodes_.to_world(node), nodes_.forward(node)}, source);
        camera.eye = opening.eye;
        camera.target = opening.target;
        camera.up = opening.up;
        for (const GltfNodes::Pose& pose : poses_at_instants(node)) {
            camera.at_instants.push_back(camera_pose(pose, source));
        }
        const auto is_opening = [&](const CameraPose& pose) { return pose == opening; };
        if (std::all_of(camera.at_instants.begin(), camera.at_instants.end(), is_opening)) camera.at_instants.clear();
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

    static CameraPose camera_pose(const GltfNodes::Pose& at, const JsonObject& source) {
        if (at.forward == glm::dvec3(0.0)) source.fail("its node's transform leaves no direction; correct it");
        CameraPose pose;
        pose.eye = glm::dvec3(at.to_world[3]);
        pose.target = pose.eye + at.forward * std::max(1.0, glm::length(pose.eye));
        pose.up = unit_or_zero(glm::dvec3(at.to_world[1]));
        return pose;
    }

    /// Where a node is at each of the shutter's instants; empty if it does not move.
    std::vector<GltfNodes::Pose> poses_at_instants(std::size_t node) const {
        std::vector<GltfNodes::Pose> poses;
        if (shutter_.is_moment() || nodes_.least_parts(node) == 0) return poses;
        for (const float time : times_of_instants(shutter_)) {
            poses.push_back(nodes_.pose(node, shutter_.second_at(static_cast<double>(time))));
        }
        return poses;
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
        const glm::vec3 position = position_of(nodes_.to_world(node));
        const std::vector<GltfNodes::Pose> poses = poses_at_instants(node);
        if (source.has("range")) {
            leave_out(scene_.left_out, "the range of lights", "light falls off with the square of the distance");
        }
        const std::string type = source.text("type");
        if (type == "point") {
            add_point_light(source, position, intensity, poses);
        } else if (type == "directional") {
            const lightcuts::DistantLight<> light{direction(source, nodes_.forward(node)), intensity};
            add_light(light, scene_.directional, scene_.at_instants.directional, poses,
                      [&](lightcuts::DistantLight<>& there, const GltfNodes::Pose& pose) {
                          there.direction = direction(source, pose.forward);
                      });
        } else if (type == "spot") {
            const JsonObject cone = source.object("spot");
            constexpr auto right_angle = static_cast<float>(std::numbers::pi / 2);
            const double wide = static_cast<double>(
                cone.number_in("outerConeAngle", right_angle / 2, 0.0f, right_angle));
            const double narrow = static_cast<double>(cone.number_in("innerConeAngle", 0.0f, 0.0f, right_angle));
            // The least width of the ramp between the cones is the extension's own.
            const double outer = std::cos(wide);
            const double inner = std::max(std::cos(narrow), outer + 0.001);
            const lightcuts::SpotLight<> light{position,
                                               direction(source, nodes_.forward(node)),
                                               intensity,
                                               {static_cast<float>(inner), static_cast<float>(outer)}};
            add_light(light, scene_.spots, scene_.at_instants.spots, poses,
                      [&](lightcuts::SpotLight<>& there, const GltfNodes::Pose& pose) {
                          there.position = position_of(pose.to_world);
                          there.axis = direction(source, pose.forward);
                      });
        } else {
            source.fail("is of the unknown type '" + excerpt(type) + "'; use point, spot or directional");
        }
    }

    /// Adds one light to `still`, or, where `place(light, pose)` gives it another place or direction in some of the
    /// `poses`, one for each to `moving`.
    template <class L, class Place>
    static void add_light(const L& light, std::vector<L>& still, std::vector<lightcuts::InstantLight<L>>& moving,
                          const std::vector<GltfNodes::Pose>& poses, const Place& place) {
        std::vector<lightcuts::InstantLight<L>> at_instants;
        bool is_moved = false;
        for (std::uint32_t t = 0; t < poses.size(); ++t) {
            L there = light;
            place(there, poses[t]);
            if constexpr (requires { there.position; }) is_moved = is_moved || there.position != light.position;
            if constexpr (requires { there.center; }) is_moved = is_moved || there.center != light.center;
            if constexpr (requires { there.axis; }) is_moved = is_moved || there.axis != light.axis;
            if constexpr (requires { there.direction; }) is_moved = is_moved || there.direction != light.direction;
            at_instants.push_back({there, t});
        }
        if (is_moved) {
            moving.insert(moving.end(), at_instants.begin(), at_instants.end());
        } else {
            still.push_back(light);
        }
    }

    glm::vec3 position_of(const glm::dmat4& to_world) const {
        return glm::vec3(glm::dvec3(to_world[3]) - scene_.origin);
    }

    static glm::vec3 direction(const JsonObject& light, const glm::dvec3& forward) {
        if (forward == glm::dvec3(0.0)) light.fail("its node's transform leaves no direction; correct it");
        return glm::vec3(forward);
    }

    /// A point light that its author gave a size is a sphere. As all of a light, the size ignores the nodes' scale.
    void add_point_light(const JsonObject& source, const glm::vec3& position, const glm::vec3& intensity,
                         const std::vector<GltfNodes::Pose>& poses) {
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
            add_light(lightcuts::SphereLight<>{position, radius, intensity}, scene_.spheres, scene_.at_instants.spheres,
                      poses, [&](lightcuts::SphereLight<>& there, const GltfNodes::Pose& pose) {
                          there.center = position_of(pose.to_world);
                      });
        } else {
            add_light(lightcuts::OmniLight<>{position, intensity}, scene_.omni, scene_.at_instants.omni, poses,
                      [&](lightcuts::OmniLight<>& there, const GltfNodes::Pose& pose) {
                          there.position = position_of(pose.to_world);
                      });
        }
    }

    Scene scene_;
    Shutter shutter_;
    GltfDocument document_;
    GltfMaterials materials_;
    GltfMeshes meshes_;
    GltfNodes nodes_;
    GltfSkins skins_;
    std::vector<glm::dvec3> positions_;  ///< in world coordinates
    std::vector<Moved> moved_;
    bool any_normal_ = false;
    bool any_color_ = false;
    bool any_tangent_ = false;
};

}  // namespace

Scene load_gltf(const std::filesystem::path& path, const FileSource& files, const Shutter& shutter) {
    try {
        return GltfReader(path, files, shutter).read();
    } catch (const invalid_input& problem) {
        const std::string message = problem.what();
        // That of the file itself names it already.
        throw message.starts_with(path.string() + ": ") ? problem : invalid_input(path.string() + ": " + message);
    }
}

}  // namespace render
