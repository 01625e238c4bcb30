#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include "scene.hpp"
#include "surfaces/surface_colors.hpp"
#include "surfaces/surface_geometry.hpp"

namespace render {

enum class Shade { full, diffuse };  ///< `diffuse`: everything is Lambert with its base color, glass too

/// How a surface spreads light.
struct SurfaceLobes {
    /// The reflecting lobe besides Lambert's diffuse/pi. `phong`: specular (e+2)/(2 pi) cos^e about the mirror
    /// direction. `microfacet`: height-correlated GGX with Schlick's Fresnel term from `specular` to `grazing`.
    /// `volume`: no surface, but a point of fog with Henyey and Greenstein's phase function.
    enum class Model : std::uint8_t { lambert, phong, microfacet, volume };

    glm::vec3 diffuse{0.0f};      ///< albedo of the Lambert part
    glm::vec3 specular{0.0f};     ///< phong: Ks; microfacet: reflectance at normal incidence (F0)
    glm::vec3 transmitted{0.0f};  ///< diffuse transmittance, of light from behind to the viewer
    float grazing = 1;            ///< microfacet: reflectance at grazing incidence, at least `specular`
    float shininess = 0;          ///< phong: exponent e; microfacet: alpha = roughness^2; volume: mean cosine
    Model model = Model::lambert;

    bool is_black() const {
        constexpr glm::vec3 black(0.0f);
        return diffuse == black && specular == black && transmitted == black;
    }
};

/// A direction in which a ray goes on from a surface as a ray, a delta function of what it scatters: through a hole or
/// a pane, or off a mirror.
struct DeltaLobe {
    glm::vec3 direction{0.0f};
    glm::vec3 share{0.0f};  ///< of the light
    bool passes = false;    ///< straight through
};

/// What a surface does with a ray.
struct SurfaceResponse {
    float opacity = 1.0f;  ///< share of the point that is there at all, and has the lobes
    SurfaceLobes lobes;

    std::span<const DeltaLobe> delta_lobes() const { return std::span(lobes_).first(count_); }
    /// pre: fewer than three so far
    void add_delta_lobe(const DeltaLobe& lobe) { lobes_[count_++] = lobe; }

private:
    std::array<DeltaLobe, 3> lobes_;
    std::size_t count_ = 0;
};

/// Reflectance by Schlick's formula is f0 + (f90 - f0) of this.
float schlick(float cosine);

/// The response of `material` with `colors` at `surface` to a ray along the unit `direction`.
SurfaceResponse response_of(const Material& material, const SurfaceColors& colors, const SurfaceGeometry& surface,
                            const glm::vec3& direction, Shade shade);

}  // namespace render
