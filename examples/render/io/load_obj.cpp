#include "io/load_obj.hpp"

#include <array>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "io/obj_geometry.hpp"
#include "io/obj_materials.hpp"
#include "io/polygon.hpp"
#include "io/text_file.hpp"
#include "io/world_origin.hpp"

namespace render {
namespace {

/// Makes one vertex of all corners with the same position, uv and normal.
class VertexWelder {
public:
    explicit VertexWelder(std::size_t positions) : first_(positions, none) {}

    /// The vertex of `corner`, and whether it is new.
    std::pair<std::uint32_t, bool> weld(const ObjCorner& corner) {
        std::uint32_t* link = &first_[static_cast<std::size_t>(corner.position)];
        while (*link != none) {
            Vertex& vertex = vertices_[*link];
            if (vertex.uv == corner.uv && vertex.normal == corner.normal) return {*link, false};
            link = &vertex.next;
        }
        const auto index = static_cast<std::uint32_t>(vertices_.size());
        *link = index;
        vertices_.push_back({corner.uv, corner.normal, none});
        return {index, true};
    }

    std::size_t size() const { return vertices_.size(); }

private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    struct Vertex {
        std::int32_t uv;
        std::int32_t normal;
        std::uint32_t next;  ///< with the same position
    };

    std::vector<std::uint32_t> first_;  ///< of each position
    std::vector<Vertex> vertices_;
};

class ObjReader {
public:
    ObjReader(const std::filesystem::path& path, const FileSource& files)
        : path_(path), geometry_(parse_obj(path, files.read(path))), materials_(path, geometry_, files, scene_),
          welder_(geometry_.positions.size()) {
        scene_.name = path.string();
        for (const LeftOut& item : geometry_.left_out) leave_out(scene_.left_out, item.what, item.why);
    }

    Scene read() {
        if (geometry_.faces.empty() && geometry_.first_short_face > 0) {
            fail_at(path_, geometry_.first_short_face, "a face needs at least 3 vertices, and the file has no other");
        }
        for (const ObjFace& face : geometry_.faces) add_face(face);
        set_positions(scene_, positions_);
        return std::move(scene_);
    }

private:
    void add_face(const ObjFace& face) {
        const std::uint32_t material = materials_.in_scene(face.material);
        const std::span<const ObjCorner> corners(&geometry_.corners[face.first], face.count);
        if (corners.front().uv == ObjCorner::none) materials_.note_no_uv(material);
        const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
            // In braces, so that vertices are numbered in this order by every compiler.
            scene_.triangles.push_back(glm::uvec3{vertex(corners[a]), vertex(corners[b]), vertex(corners[c])});
            scene_.triangle_material.push_back(material);
        };
        if (face.count == 3) {
            add(0, 1, 2);
            return;
        }
        outline_.clear();
        for (const ObjCorner& corner : corners) outline_.push_back(position_of(corner));
        for (const auto& [a, b, c] : triangles_of(outline_)) add(a, b, c);
    }

    const glm::dvec3& position_of(const ObjCorner& corner) const {
        return geometry_.positions[static_cast<std::size_t>(corner.position)];
    }

    std::uint32_t vertex(const ObjCorner& corner) {
        if (welder_.size() >= std::numeric_limits<std::uint32_t>::max() - 1) {
            throw lightcuts::invalid_input(path_.string() + ": too many vertices; split it");
        }
        const auto [index, is_new] = welder_.weld(corner);
        if (!is_new) return index;
        positions_.push_back(position_of(corner));
        if (!geometry_.colors.empty()) {
            scene_.colors.emplace_back(geometry_.colors[static_cast<std::size_t>(corner.position)], 1.0f);
        }
        if (!geometry_.normals.empty()) scene_.normals.push_back(normal_of(corner));
        if (!geometry_.uvs.empty()) {
            scene_.uv_sets.resize(1);
            scene_.uv_sets[0].push_back(uv_of(corner));
        }
        return index;
    }

    /// Zero where there is none.
    glm::vec3 normal_of(const ObjCorner& corner) const {
        if (corner.normal == ObjCorner::none) return glm::vec3(0.0f);
        const glm::dvec3 normal(geometry_.normals[static_cast<std::size_t>(corner.normal)]);
        const double length = glm::length(normal);
        return length > 0.0 ? glm::vec3(normal / length) : glm::vec3(0.0f);
    }

    /// A texture's v runs downwards.
    glm::vec2 uv_of(const ObjCorner& corner) const {
        if (corner.uv == ObjCorner::none) return {0.0f, 1.0f};
        const glm::dvec2& uv = geometry_.uvs[static_cast<std::size_t>(corner.uv)];
        return glm::vec2(glm::dvec2(uv.x, 1.0 - uv.y));
    }

    const std::filesystem::path& path_;
    Scene scene_;
    ObjGeometry geometry_;
    ObjMaterials materials_;
    VertexWelder welder_;
    std::vector<glm::dvec3> positions_;  ///< of the scene's vertices, in world coordinates
    std::vector<glm::dvec3> outline_;
};

}  // namespace

Scene load_obj(const std::filesystem::path& path, const FileSource& files) { return ObjReader(path, files).read(); }

}  // namespace render
