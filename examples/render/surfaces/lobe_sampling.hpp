#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "surfaces/surface_lobes.hpp"

namespace render {

/// Mean of the channels, by which probabilities are shared out.
inline double mean(const glm::vec3& v) { return (static_cast<double>(v.x) + v.y + v.z) / 3.0; }

/// Draws directions from the lobes of a surface seen from one side.
class LobeSampler {
public:
    /// `normal`, `to_viewer`: unit
    LobeSampler(const SurfaceLobes& lobes, const glm::vec3& normal, const glm::vec3& to_viewer);

    /// Sum of channels / 3 that the Lambert part reflects, and about what the other lobe does.
    double diffuse_share() const { return diffuse_share_; }
    double gloss_share() const { return gloss_share_; }

    /// A unit direction about the normal with the density cos / pi. `u`: in [0, 1)
    glm::dvec3 diffuse(const glm::dvec2& u) const;
    /// A unit direction of the glossy lobe, maybe below the surface.
    glm::dvec3 glossy(const glm::dvec2& u) const;

    /// Density of `direction` per solid angle, if `diffuse` is called in a share `probability` of the cases.
    double density(const glm::dvec3& direction, double probability) const;

private:
    double glossy_density(const glm::dvec3& direction) const;

    SurfaceLobes::Model model_;
    double shininess_;
    glm::dvec3 normal_, view_;
    glm::dvec3 mirror_{0.0};  ///< the axis of Phong's lobe
    double diffuse_share_ = 0, gloss_share_ = 0;
};

}  // namespace render
