#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "rays/ray_scene.hpp"
#include "scene.hpp"
#include "surfaces/surface_lobes.hpp"
#include "view.hpp"

namespace render {

/// A point to be shaded: a receiver of light, with what reflects it there.
struct SurfacePoint : SurfaceLobes {
    glm::vec3 position{0.0f};
    glm::vec3 ray_origin{0.0f};        ///< where shadow rays start: off the surface along `geometric_normal`
    glm::vec3 geometric_normal{0.0f};  ///< unit, towards the viewer
    glm::vec3 shading_normal{0.0f};    ///< unit, towards the viewer, above the surface
    glm::vec3 to_viewer{0.0f};         ///< unit
    float distance = 0;                ///< traveled from the eye to here
    glm::vec3 weight{1.0f};            ///< share of this point's radiance in its eye ray's
    std::uint32_t pixel = 0;           ///< y * width + x
    std::uint32_t sample = 0;          ///< eye ray within the pixel
    std::uint32_t vertex = 0;          ///< point of the eye ray: 0, and more behind mirrors, glass and leaves
    std::uint32_t instant = 0;         ///< of the eye ray
    std::uint32_t triangle = 0;        ///< of the scene; of fog 0
    float u = 0, v = 0;                ///< barycentric, of its second and third corner
};

/// The id of the receiver at a point: a hash of it, so that random choices differ between pixels, eye rays and the
/// points of one eye ray, and in its lowest bits the instant, which tells oracles when to look.
std::uint32_t receiver_name(const Scene& scene, const SurfacePoint& point);

/// What an eye ray met besides points to be shaded.
struct EyeRaySeen {
    glm::vec3 emitted{0.0f};  ///< radiance of emitters and background in sight, also in mirrors and through glass
    float depth = 0;          ///< distance to the first surface; infinite where there is none
    glm::vec3 normal{0.0f};   ///< shading normal of the first surface; 0 where there is none
};

/// Part of an eye ray that met no surface.
struct Escape {
    glm::vec3 direction{0.0f};  ///< unit
    glm::vec3 weight{1.0f};     ///< share of what comes from there in the eye ray's radiance
    std::uint32_t pixel = 0;
};

/// Finds the points that eye rays see: directly, through masks and leaves, in mirrors and through glass.
/// threads: `follow` may run at once for different rays.
class EyePathTracer {
public:
    /// `scene` and `rays` must outlive this object.
    EyePathTracer(const Scene& scene, const RayScene& rays, Shade shade) : scene_(scene), rays_(rays), shade_(shade) {}

    /// Appends to `points` what `ray` sees that reflects light, in a fixed order. Both parts of light at glass are
    /// followed; parts below 1e-4 of the ray are not. cost: one ray cast, more at mirrors, glass and leaves (at
    /// most 2^8 along glass).
    EyeRaySeen follow(const EyeRay& ray, std::uint32_t pixel, std::uint32_t sample,
                      std::vector<SurfacePoint>& points) const;

    /// The same for a background that changes: instead of its radiance, appends to `escapes` where it is looked up.
    EyeRaySeen follow(const EyeRay& ray, std::uint32_t pixel, std::uint32_t sample, std::vector<SurfacePoint>& points,
                      std::vector<Escape>& escapes) const;

private:
    template <class Background>
    EyeRaySeen follow_until(const EyeRay& ray, std::uint32_t pixel, std::uint32_t sample,
                            std::vector<SurfacePoint>& points, Background&& background) const;

    const Scene& scene_;
    const RayScene& rays_;
    Shade shade_;
};

}  // namespace render
