#include "load_obj.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <tiny_obj_loader.h>
#include <glm/common.hpp>
#include <lightcuts/core/invalid_input.hpp>

#include "check_obj.hpp"
#include "luminance.hpp"
#include "text_file.hpp"
#include "texture.hpp"

namespace render {
namespace {

glm::vec3 to_vec3(const tinyobj::real_t (&v)[3]) { return {v[0], v[1], v[2]}; }

class ObjReader {
public:
    explicit ObjReader(const std::filesystem::path& path) : path_(path) { scene_.name = path.string(); }

    Scene read() {
        const std::string text = read_file(path_);
        const MaterialUses uses = check_obj(path_, text);
        std::istringstream stream(text);
        std::string folder = path_.parent_path().string();
        if (!folder.empty()) folder += '/';
        tinyobj::MaterialFileReader libraries(folder);
        std::string warning;
        std::string error;
        if (!tinyobj::LoadObj(&attributes_, &shapes_, &materials_, &warning, &error, &stream, &libraries)) {
            fail("not an OBJ file that can be read (" + error.substr(0, error.find('\n')) + "); export it again");
        }

        for (const tinyobj::material_t& m : materials_) add_material(m);
        for (const auto& use : uses) {
            if (std::none_of(materials_.begin(), materials_.end(),
                             [&](const auto& m) { return m.name == use.first; })) {
                fail_at(path_, use.second,
                        "the material '" + use.first + "' is in no library; add it or correct the name");
            }
        }
        for (const tinyobj::shape_t& shape : shapes_) add_mesh(shape.mesh);
        if (attributes_.normals.empty()) scene_.normals.clear();
        if (attributes_.texcoords.empty()) scene_.uvs.clear();
        return std::move(scene_);
    }

private:
    [[noreturn]] void fail(const std::string& message) const {
        throw lightcuts::invalid_input(path_.string() + ": " + message);
    }

    enum class Role { color, alpha };

    int texture(const std::string& name, Role role = Role::color) {
        if (name.empty()) return no_texture;
        const auto [entry, is_new] = textures_.try_emplace({name, role}, static_cast<int>(scene_.textures.size()));
        if (is_new) {
            std::string portable = name;
            std::replace(portable.begin(), portable.end(), '\\', '/');
            const bool is_color = role == Role::color;
            scene_.textures.push_back(read_texture(path_.parent_path() / portable, is_color));
            if (!is_color) make_mask(scene_.textures.back());
        }
        return entry->second;
    }

    /// Brightness becomes alpha, unless the picture has an alpha of its own.
    static void make_mask(Texture& texture) {
        if (has_holes(texture)) return;
        for (glm::vec4& t : texture.texels) {
            const bool grey = t.r == t.g && t.g == t.b;
            t.a = grey ? t.r : luminance(glm::vec3(t));
        }
    }

    static bool has_holes(const Texture& texture) {
        return std::any_of(texture.texels.begin(), texture.texels.end(), [](const glm::vec4& t) { return t.a < 1.0f; });
    }

    void add_material(const tinyobj::material_t& source) {
        Material m;
        m.name = source.name;
        m.model = Material::Model::phong;
        m.base_color = to_vec3(source.diffuse);
        m.specular = source.shininess > 0.0f ? to_vec3(source.specular) : glm::vec3(0.0f);
        m.exponent = source.shininess;
        m.emission = to_vec3(source.emission);
        if (m.emission != glm::vec3(0.0f)) m.emission_texture = texture(source.emissive_texname);
        m.base_alpha = std::clamp(source.dissolve, 0.0f, 1.0f);
        if (source.illum == 5) {
            m.model = Material::Model::mirror;
            m.base_color = to_vec3(source.specular);
        } else if (source.illum == 7) {
            const glm::vec3 filter = to_vec3(source.transmittance);
            m.model = Material::Model::glass;
            m.base_color = filter == glm::vec3(0.0f) ? glm::vec3(1.0f) : glm::min(filter, 1.0f);
            m.ior = source.ior;
            m.transmission = 1.0f;
        } else {
            m.base_color_texture = texture(source.diffuse_texname);
            m.alpha_texture = texture(source.alpha_texname, Role::alpha);
            const int alpha = m.alpha_texture != no_texture ? m.alpha_texture : m.base_color_texture;
            const bool holes = alpha != no_texture && has_holes(scene_.textures[static_cast<std::size_t>(alpha)]);
            if (m.base_alpha < 1.0f || holes) m.alpha = Material::Alpha::blend;
        }
        scene_.materials.push_back(m);
    }

    std::uint32_t default_material() {
        if (default_material_ < 0) {
            default_material_ = static_cast<int>(scene_.materials.size());
            Material grey;
            grey.name = "default";
            grey.model = Material::Model::phong;
            scene_.materials.push_back(grey);
        }
        return static_cast<std::uint32_t>(default_material_);
    }

    void add_mesh(const tinyobj::mesh_t& mesh) {
        for (std::size_t face = 0; face < mesh.num_face_vertices.size(); ++face) {
            const int id = mesh.material_ids[face];
            const std::size_t first = 3 * face;
            scene_.triangles.emplace_back(vertex(mesh.indices[first]), vertex(mesh.indices[first + 1]),
                                          vertex(mesh.indices[first + 2]));
            scene_.triangle_material.push_back(id < 0 ? default_material() : static_cast<std::uint32_t>(id));
        }
    }

    /// The vertex with these attributes; equal ones are shared.
    std::uint32_t vertex(const tinyobj::index_t& index) {
        const std::array key{index.vertex_index, index.normal_index, index.texcoord_index};
        if (scene_.positions.size() > std::numeric_limits<std::uint32_t>::max() - 1)
            fail("too many vertices; split it");
        const auto [entry, is_new] = vertices_.try_emplace(key, static_cast<std::uint32_t>(scene_.positions.size()));
        if (!is_new) return entry->second;
        const auto read = [](const std::vector<tinyobj::real_t>& all, int i, std::size_t width) {
            glm::vec3 v(0.0f);
            if (i >= 0) {
                for (std::size_t c = 0; c < width; ++c) {
                    v[static_cast<int>(c)] = all[static_cast<std::size_t>(i) * width + c];
                }
            }
            return v;
        };
        scene_.positions.push_back(read(attributes_.vertices, index.vertex_index, 3));
        scene_.normals.push_back(read(attributes_.normals, index.normal_index, 3));
        const glm::vec3 uv = read(attributes_.texcoords, index.texcoord_index, 2);
        scene_.uvs.emplace_back(uv.x, 1.0f - uv.y);  // OBJ's v runs upwards
        return entry->second;
    }

    std::filesystem::path path_;
    tinyobj::attrib_t attributes_;
    std::vector<tinyobj::shape_t> shapes_;
    std::vector<tinyobj::material_t> materials_;
    Scene scene_;
    std::map<std::pair<std::string, Role>, int> textures_;
    std::map<std::array<int, 3>, std::uint32_t> vertices_;
    int default_material_ = -1;
};

}  // namespace

Scene load_obj(const std::filesystem::path& path) { return ObjReader(path).read(); }

}  // namespace render
