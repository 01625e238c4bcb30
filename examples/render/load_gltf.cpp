#include "load_gltf.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <tiny_gltf.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <lightcuts/core/invalid_input.hpp>
#include <lightcuts/core/vector.hpp>

#include "gltf_accessor.hpp"
#include "gltf_diffuse_transmission.hpp"
#include "gltf_texture_info.hpp"
#include "text_file.hpp"
#include "texture.hpp"

namespace render {
namespace {

constexpr std::array supported_extensions{"KHR_lights_punctual",        "KHR_materials_emissive_strength",
                                          "KHR_materials_transmission", "KHR_materials_ior",
                                          "KHR_mesh_quantization",      "KHR_materials_volume",
                                          "KHR_texture_transform",      "KHR_materials_diffuse_transmission"};

double number(const tinygltf::Value& value, double otherwise) {
    return value.IsNumber() ? value.GetNumberAsDouble() : otherwise;
}

/// The value `key` in the extension `name`, or a null value.
tinygltf::Value extension_value(const tinygltf::ExtensionMap& extensions, const char* name, const char* key) {
    const auto found = extensions.find(name);
    return found != extensions.end() && found->second.Has(key) ? found->second.Get(key) : tinygltf::Value();
}

glm::vec3 to_vec3(const std::vector<double>& v, double otherwise) {
    const auto at = [&](std::size_t i) { return static_cast<float>(i < v.size() ? v[i] : otherwise); };
    return {at(0), at(1), at(2)};
}

/// The first line of a message that may have several.
std::string first_line(const std::string& message) {
    const std::size_t begin = message.find_first_not_of(" \n");
    if (begin == std::string::npos) return "unknown error";
    std::string line = message.substr(begin, message.find('\n', begin) - begin);
    while (!line.empty() && (line.back() == '.' || line.back() == ' ')) line.pop_back();
    return line;
}

glm::dmat4 local_transform(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) return glm::make_mat4(node.matrix.data());
    glm::dmat4 m(1.0);
    if (node.translation.size() == 3) m = glm::translate(m, glm::make_vec3(node.translation.data()));
    if (node.rotation.size() == 4) {
        const auto& q = node.rotation;
        m *= glm::mat4_cast(glm::normalize(glm::dquat(q[3], q[0], q[1], q[2])));
    }
    if (node.scale.size() == 3) m = glm::scale(m, glm::make_vec3(node.scale.data()));
    return m;
}

class GltfReader {
public:
    explicit GltfReader(const std::filesystem::path& path) : path_(path) {
        scene_.name = path.string();
        parse();
    }

    Scene read() {
        for (const tinygltf::Material& m : model_.materials) add_material(m);
        for (const int root : roots()) add_node(root, glm::dmat4(1.0), 0);
        if (!any_uv_) scene_.uvs.clear();
        if (!any_normal_) scene_.normals.clear();
        return std::move(scene_);
    }

private:
    [[noreturn]] void fail(const std::string& message) const {
        throw lightcuts::invalid_input(path_.string() + ": " + message);
    }

    void parse() {
        const std::string bytes = read_file(path_);
        const auto size = static_cast<unsigned int>(bytes.size());
        const std::string folder = path_.parent_path().string();
        tinygltf::TinyGLTF loader;
        std::string error;
        std::string warning;
        bool good = false;
        try {
            good = bytes.starts_with("glTF")
                       ? loader.LoadBinaryFromMemory(&model_, &error, &warning,
                                                     reinterpret_cast<const unsigned char*>(bytes.data()), size, folder)
                       : loader.LoadASCIIFromString(&model_, &error, &warning, bytes.data(), size, folder);
        } catch (const std::exception& exception) { error = exception.what(); }
        if (!good) fail("not a whole glTF 2.0 file (" + first_line(error) + "); export it again");
        for (const std::string& name : model_.extensionsRequired) {
            if (std::find(supported_extensions.begin(), supported_extensions.end(), name) ==
                supported_extensions.end()) {
                fail("requires the extension " + name + ", which is not supported; export without it");
            }
        }
    }

    /// The default scene's root nodes; of a file without scenes, the nodes that are nobody's child.
    std::vector<int> roots() const {
        if (!model_.scenes.empty()) {
            const auto index = static_cast<std::size_t>(std::max(model_.defaultScene, 0));
            if (index >= model_.scenes.size()) fail("the default scene does not exist; correct `scene`");
            return model_.scenes[index].nodes;
        }
        std::set<int> children;
        for (const tinygltf::Node& node : model_.nodes) children.insert(node.children.begin(), node.children.end());
        std::vector<int> result;
        for (int i = 0; i < static_cast<int>(model_.nodes.size()); ++i) {
            if (!children.contains(i)) result.push_back(i);
        }
        return result;
    }

    template <class T>
    const T& element(const std::vector<T>& all, int index, const std::string& what) const {
        if (index < 0 || static_cast<std::size_t>(index) >= all.size()) {
            fail(what + " " + std::to_string(index) + " does not exist; the file is damaged");
        }
        return all[static_cast<std::size_t>(index)];
    }

    // ---- materials and textures

    /// Index of the texture in the scene. One that serves as colour and as data becomes two.
    int texture(int index, bool srgb) {
        if (index < 0) return no_texture;
        const auto [entry, is_new] = textures_.try_emplace({index, srgb}, static_cast<int>(scene_.textures.size()));
        if (!is_new) return entry->second;
        const tinygltf::Texture& source = element(model_.textures, index, "texture");
        const tinygltf::Image& image = element(model_.images, source.source, "texture image");
        const std::string name = !image.uri.empty() ? image.uri : image.name.empty() ? source.name : image.name;
        if (image.image.empty()) fail("the texture '" + name + "' is not there; put the file beside the scene");
        Texture texture;
        try {
            texture = make_texture(
                name, {image.width, image.height, image.component, image.bits, image.image.data(), image.image.size()},
                srgb);
        } catch (const lightcuts::invalid_input& problem) { fail(problem.what()); }
        if (source.sampler >= 0) {
            const tinygltf::Sampler& sampler = element(model_.samplers, source.sampler, "sampler");
            texture.wrap_u = wrap(sampler.wrapS);
            texture.wrap_v = wrap(sampler.wrapT);
        }
        scene_.textures.push_back(std::move(texture));
        return entry->second;
    }

    static Texture::Wrap wrap(int mode) {
        if (mode == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE) return Texture::Wrap::clamp;
        return mode == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? Texture::Wrap::mirror : Texture::Wrap::repeat;
    }

    void add_material(const tinygltf::Material& source) {
        const tinygltf::PbrMetallicRoughness& pbr = source.pbrMetallicRoughness;
        Material m;
        m.name = source.name;
        m.base_color = to_vec3(pbr.baseColorFactor, 1.0);
        m.base_alpha = pbr.baseColorFactor.size() > 3 ? static_cast<float>(pbr.baseColorFactor[3]) : 1.0f;
        m.base_color_texture = texture(pbr.baseColorTexture.index, true);
        m.metallic = static_cast<float>(pbr.metallicFactor);
        m.roughness = static_cast<float>(pbr.roughnessFactor);
        m.metallic_roughness_texture = texture(pbr.metallicRoughnessTexture.index, false);
        const double strength = number(
            extension_value(source.extensions, "KHR_materials_emissive_strength", "emissiveStrength"), 1.0);
        m.emission = to_vec3(source.emissiveFactor, 0.0) * static_cast<float>(strength);
        if (m.emission != glm::vec3(0.0f)) m.emission_texture = texture(source.emissiveTexture.index, true);
        m.ior = static_cast<float>(number(extension_value(source.extensions, "KHR_materials_ior", "ior"), 1.5));
        m.transmission = static_cast<float>(
            number(extension_value(source.extensions, "KHR_materials_transmission", "transmissionFactor"), 0.0));
        const auto thin = of_material(source, [&] { return diffuse_transmission(source.extensions); });
        add_diffuse_transmission(thin, m);
        m.double_sided = source.doubleSided;
        if (source.alphaMode == "MASK") m.alpha = Material::Alpha::mask;
        if (source.alphaMode == "BLEND") m.alpha = Material::Alpha::blend;
        m.alpha_cutoff = static_cast<float>(source.alphaCutoff);
        uv_sets_.push_back(add_texture_uses(source, thin, m));
        scene_.materials.push_back(m);
    }

    void add_diffuse_transmission(const GltfDiffuseTransmission& source, Material& m) {
        m.diffuse_transmission = source.factor;
        if (m.diffuse_transmission == 0.0f) return;
        m.diffuse_transmission_texture = texture(source.texture.index, false);
        m.diffuse_transmission_color = source.color;
        m.diffuse_transmission_color_texture = texture(source.color_texture.index, true);
    }

    /// What `read` returns; what it refuses is said of the material.
    template <class Read>
    std::invoke_result_t<Read> of_material(const tinygltf::Material& source, const Read& read) const {
        try {
            return read();
        } catch (const lightcuts::invalid_input& problem) { fail("material '" + source.name + "': " + problem.what()); }
    }

    /// Says how the material's textures are addressed; returns the one set of uvs that all of them ask for.
    int add_texture_uses(const tinygltf::Material& source, const GltfDiffuseTransmission& thin, Material& m) const {
        int set = -1;
        const auto add = [&](int texture, const tinygltf::TextureInfo& info, UvTransform& transform) {
            if (texture == no_texture) return;
            const TextureUse use = of_material(source, [&] { return texture_use(info.texCoord, info.extensions); });
            if (set >= 0 && set != use.uv_set) {
                fail("material '" + source.name + "' uses two sets of texture coordinates; export with one");
            }
            set = use.uv_set;
            transform = use.transform;
        };
        add(m.base_color_texture, source.pbrMetallicRoughness.baseColorTexture, m.base_color_uv);
        add(m.metallic_roughness_texture, source.pbrMetallicRoughness.metallicRoughnessTexture,
            m.metallic_roughness_uv);
        add(m.emission_texture, source.emissiveTexture, m.emission_uv);
        add(m.diffuse_transmission_texture, thin.texture, m.diffuse_transmission_uv);
        add(m.diffuse_transmission_color_texture, thin.color_texture, m.diffuse_transmission_color_uv);
        return std::max(set, 0);
    }

    /// The material that the format gives to a primitive without one.
    std::uint32_t default_material() {
        if (default_material_ < 0) {
            default_material_ = static_cast<int>(scene_.materials.size());
            add_material(tinygltf::Material());
        }
        return static_cast<std::uint32_t>(default_material_);
    }

    // ---- nodes

    void add_node(int index, const glm::dmat4& parent, std::size_t depth) {
        if (depth > model_.nodes.size()) fail("a node is its own ancestor; the file is damaged");
        const tinygltf::Node& node = element(model_.nodes, index, "node");
        const glm::dmat4 transform = parent * local_transform(node);
        if (node.mesh >= 0) add_mesh(element(model_.meshes, node.mesh, "mesh"), transform);
        if (node.camera >= 0) add_camera(element(model_.cameras, node.camera, "camera"), node.name, transform);
        const tinygltf::Value light = extension_value(node.extensions, "KHR_lights_punctual", "light");
        if (light.IsInt()) add_light(element(model_.lights, light.GetNumberAsInt(), "light"), node.name, transform);
        for (const int child : node.children) add_node(child, transform, depth + 1);
    }

    /// Cameras and lights look along their node's -z.
    glm::vec3 forward(const glm::dmat4& transform, const std::string& what) const {
        const glm::dvec3 axis = -glm::dvec3(transform[2]);
        if (!(glm::length(axis) > 0.0)) fail(what + " has an axis of zero length; correct its node's transform");
        return glm::normalize(axis);
    }

    void add_camera(const tinygltf::Camera& source, const std::string& node_name, const glm::dmat4& transform) {
        if (source.type != "perspective") return;
        Camera camera;
        camera.name = !source.name.empty() ? source.name
                      : !node_name.empty() ? node_name
                                           : "camera " + std::to_string(scene_.cameras.size());
        camera.eye = glm::vec3(transform[3]);
        camera.target = camera.eye +
                        forward(transform, "camera '" + camera.name + "'") * std::max(1.0f, glm::length(camera.eye));
        camera.up = glm::vec3(transform[1]);
        camera.vertical_fov = static_cast<float>(source.perspective.yfov * 180.0 / std::numbers::pi);
        scene_.cameras.push_back(camera);
    }

    void add_light(const tinygltf::Light& source, const std::string& node_name, const glm::dmat4& transform) {
        const std::string name = "light '" + (source.name.empty() ? node_name : source.name) + "'";
        const glm::vec3 intensity = to_vec3(source.color, 1.0) * static_cast<float>(source.intensity);
        const glm::vec3 position(transform[3]);
        if (!(std::min({intensity.x, intensity.y, intensity.z}) >= 0.0f) || !lightcuts::is_finite(intensity)) {
            fail(name + ": its intensity is negative or not finite; correct it");
        }
        if (source.type == "point") {
            add_point_light(source, name, position, intensity);
        } else if (source.type == "directional") {
            scene_.directional.push_back({forward(transform, name), intensity});
        } else if (source.type == "spot") {
            // The least width of the ramp between the cones is the extension's own.
            const double outer = std::cos(source.spot.outerConeAngle);
            const double inner = std::max(std::cos(source.spot.innerConeAngle), outer + 0.001);
            scene_.spots.push_back({position,
                                    forward(transform, name),
                                    intensity,
                                    {static_cast<float>(inner), static_cast<float>(outer)}});
        } else {
            fail(name + " is of the unknown type '" + source.type + "'; use point, spot or directional");
        }
    }

    /// A point light that its author gave a size is a sphere. As all of a light, the size ignores the nodes' scale.
    void add_point_light(const tinygltf::Light& source, const std::string& name, const glm::vec3& position,
                         const glm::vec3& intensity) {
        if (!source.extras.Has("radius")) {
            scene_.omni.push_back({position, intensity});
            return;
        }
        const auto radius = static_cast<float>(number(source.extras.Get("radius"), -1.0));
        if (!(radius >= 0.0f && std::isfinite(radius))) {
            fail(name + ": the radius in its extras is no number of at least 0; correct or remove it");
        }
        if (radius > 0.0f) {
            scene_.spheres.push_back({position, radius, intensity});
        } else {
            scene_.omni.push_back({position, intensity});
        }
    }

    // ---- meshes

    void add_mesh(const tinygltf::Mesh& mesh, const glm::dmat4& transform) {
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            add_primitive(mesh.primitives[i], transform, "mesh '" + mesh.name + "' primitive " + std::to_string(i));
        }
    }

    void add_primitive(const tinygltf::Primitive& primitive, const glm::dmat4& transform, const std::string& what) {
        const bool list = primitive.mode == TINYGLTF_MODE_TRIANGLES;
        const bool strip = primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
        const bool fan = primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
        if (!list && !strip && !fan) return;  // points and lines have no surface
        const std::vector<double> positions = attribute(primitive, "POSITION", 3, what);
        if (positions.empty()) return;
        const std::uint32_t material = primitive.material < 0 ? default_material()
                                                              : static_cast<std::uint32_t>(primitive.material);
        if (material >= scene_.materials.size()) fail(what + " has a material that does not exist");
        const std::string uv_name = "TEXCOORD_" + std::to_string(uv_sets_[material]);
        const std::vector<double> normals = attribute(primitive, "NORMAL", 3, what);
        const std::vector<double> uvs = attribute(primitive, uv_name, 2, what);
        const std::size_t count = positions.size() / 3;
        if ((!normals.empty() && normals.size() / 3 != count) || (!uvs.empty() && uvs.size() / 2 != count)) {
            fail(what + ": its attributes differ in length; the file is damaged");
        }

        const auto first = static_cast<std::uint32_t>(scene_.positions.size());
        const glm::dmat3 linear(transform);
        const double determinant = glm::determinant(linear);
        const glm::dmat3 normal_matrix = determinant != 0.0 ? glm::transpose(glm::inverse(linear)) : glm::dmat3(1.0);
        for (std::size_t v = 0; v < count; ++v) {
            const glm::dvec4 p(positions[3 * v], positions[3 * v + 1], positions[3 * v + 2], 1.0);
            scene_.positions.emplace_back(transform * p);
            glm::dvec3 n(0.0);
            if (!normals.empty())
                n = normal_matrix * glm::dvec3(normals[3 * v], normals[3 * v + 1], normals[3 * v + 2]);
            scene_.normals.emplace_back(glm::length(n) > 0.0 ? glm::normalize(n) : n);
            scene_.uvs.emplace_back(uvs.empty() ? glm::vec2(0.0f) : glm::vec2(uvs[2 * v], uvs[2 * v + 1]));
        }
        any_normal_ = any_normal_ || !normals.empty();
        any_uv_ = any_uv_ || !uvs.empty();

        const std::vector<std::uint32_t> corners = indices(primitive, count, what);
        const auto emit = [&](std::size_t a, std::size_t b, std::size_t c) {
            glm::uvec3 triangle(first + corners[a], first + corners[b], first + corners[c]);
            if (determinant < 0.0) std::swap(triangle.y, triangle.z);  // a mirroring transform turns the winding
            scene_.triangles.push_back(triangle);
            scene_.triangle_material.push_back(material);
        };
        for (std::size_t i = 0; i + 2 < corners.size(); i += list ? 3 : 1) {
            if (list) emit(i, i + 1, i + 2);
            if (strip) i % 2 == 0 ? emit(i, i + 1, i + 2) : emit(i + 1, i, i + 2);
            if (fan) emit(0, i + 1, i + 2);
        }
    }

    std::vector<double> attribute(const tinygltf::Primitive& primitive, const std::string& name, int components,
                                  const std::string& what) const {
        const auto found = primitive.attributes.find(name);
        if (found == primitive.attributes.end()) return {};
        return values(found->second, components, what + " " + name);
    }

    std::vector<double> values(int accessor, int components, const std::string& what) const {
        try {
            return read_accessor(model_, accessor, components);
        } catch (const lightcuts::invalid_input& problem) { fail(what + ": " + problem.what()); }
    }

    std::vector<std::uint32_t> indices(const tinygltf::Primitive& primitive, std::size_t count,
                                       const std::string& what) const {
        std::vector<std::uint32_t> result;
        if (primitive.indices < 0) {
            for (std::size_t i = 0; i < count; ++i) result.push_back(static_cast<std::uint32_t>(i));
            return result;
        }
        for (const double v : values(primitive.indices, 1, what + " indices")) {
            if (!(v >= 0.0 && v < static_cast<double>(count))) {
                fail(what + ": an index is past its " + std::to_string(count) + " vertices; the file is damaged");
            }
            result.push_back(static_cast<std::uint32_t>(v));
        }
        return result;
    }

    std::filesystem::path path_;
    tinygltf::Model model_;
    Scene scene_;
    std::map<std::pair<int, bool>, int> textures_;
    std::vector<int> uv_sets_;  ///< per material
    int default_material_ = -1;
    bool any_normal_ = false;
    bool any_uv_ = false;
};

}  // namespace

Scene load_gltf(const std::filesystem::path& path) { return GltfReader(path).read(); }

}  // namespace render
