#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <lightcuts/source/emitter.hpp>

#include "lights/emission_range.hpp"
#include "scene.hpp"
#include "surfaces/surface_colors.hpp"

namespace render {

/// What some of a scene's triangles emit on their fronts: a `lightcuts::BoundedEmissiveMesh`.
class SceneEmitter {
public:
    /// `range`: of the triangles' materials. All must outlive this object.
    SceneEmitter(const Scene& scene, const EmissionRange& range, std::span<const std::uint32_t> triangles)
        : scene_(scene), range_(range), triangles_(triangles) {}

    std::size_t triangle_count() const { return triangles_.size(); }
    const glm::vec3& corner(std::uint32_t t, int k) const {
        return scene_.positions[scene_.triangles[triangles_[t]][k]];
    }
    glm::vec3 radiance(std::uint32_t t, const glm::vec2& uv) const {
        return emitted_radiance(scene_, triangles_[t], uv.x, uv.y, true);
    }
    bool is_textured(std::uint32_t t) const {
        return has_varying_emission(scene_, scene_.materials[scene_.triangle_material[triangles_[t]]]);
    }
    lightcuts::RadianceRange<> radiance_range(std::uint32_t t, const lightcuts::PieceCorners& corners) const {
        return range_.over(triangles_[t], corners);
    }
    std::optional<std::size_t> edge_to_cut(std::uint32_t t, const lightcuts::PieceCorners& corners) const {
        return range_.longest_edge(triangles_[t], corners);
    }

private:
    const Scene& scene_;
    const EmissionRange& range_;
    std::span<const std::uint32_t> triangles_;
};

}  // namespace render
