#include "bounce.hpp"

namespace relight {

Bounce::Bounce(const RelightFile& file, const render::Scene& scene, const Sites& sites, const SeenPoints& seen,
               render::Shade shade)
    : points_(points_of(file.patches(), scene, shade)), own_lobes_(points_.points.begin(), points_.points.end()),
      reflection_(file, sites, points_), light_(file.patches()), shader_(file, sites, seen),
      radiance_(points_.points.size()) {}

void Bounce::add(const Illumination& sky, const BounceOptions& options, const RelitOptions& lobes,
                 std::span<glm::vec3> radiance) {
    reflection_.shade(sky, lobes, radiance_);
    for (std::size_t i = 0; i < radiance_.size(); ++i) radiance_[i] *= points_.points[i].weight;
    light_.set(radiance_, options.size, options.relative_error);
    shader_.add(light_, options, lobes, radiance);
}

}  // namespace relight
