#pragma once

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <render/surfaces/surface.hpp>

namespace relight {

inline bool is_glossy(const render::SurfacePoint& point) { return point.model != render::SurfacePoint::Model::lambert; }

/// Where the lobe of a glossy point lies, and how finely light has to be looked at there.
class GlossyLobe {
public:
    /// `detail`: largest radius of a cluster in the lobe, as a share of its width.
    GlossyLobe(const render::SurfacePoint& point, float detail)
        : mirrored_(2.0f * glm::dot(point.shading_normal, point.to_viewer) * point.shading_normal - point.to_viewer),
          width_(width_of(point)), detail_(detail) {}

    /// True if the lobe varies over a cluster of the radius `radius`, an angle, about `direction`: it is wide and near
    /// the lobe's middle.
    bool is_coarse(float radius, const glm::vec3& direction) const {
        if (!(radius > detail_ * width_)) return false;
        const float near = radius + 3.0f * width_;
        return 2.0f - 2.0f * glm::dot(mirrored_, direction) < near * near;
    }

    /// The same point without its diffuse parts.
    static render::SurfacePoint alone(render::SurfacePoint point) {
        point.diffuse = glm::vec3(0.0f);
        point.transmitted = glm::vec3(0.0f);
        return point;
    }

private:
    /// About where a lobe has fallen to half, from its middle: radians.
    static float width_of(const render::SurfacePoint& point) {
        // The mirror direction turns by twice the angle of a facet.
        if (point.model == render::SurfacePoint::Model::microfacet) return 2.0f * point.shininess;
        return std::sqrt(2.0f / (point.shininess + 2.0f));
    }

    glm::vec3 mirrored_;
    float width_;
    float detail_;
};

}  // namespace relight
