#include "material_change.hpp"

#include <algorithm>
#include <cstddef>

#include <oneapi/tbb/parallel_for.h>
#include <glm/common.hpp>

namespace relight {

namespace {

constexpr float least_alpha = 4e-4f;

}  // namespace

render::SurfaceLobes changed(const render::SurfaceLobes& lobes, const MaterialChange& change) {
    using Model = render::SurfaceLobes::Model;
    render::SurfaceLobes result = lobes;
    if (change.albedo != 1.0f) {
        for (int c = 0; c < 3; ++c) {
            const float whole = lobes.diffuse[c] + lobes.transmitted[c];
            const float factor = whole > 0.0f ? std::min(change.albedo, 1.0f / whole) : change.albedo;
            result.diffuse[c] *= factor;
            result.transmitted[c] *= factor;
        }
    }
    if (change.gloss_width != 1.0f) {
        const float w = change.gloss_width;
        if (lobes.model == Model::microfacet) result.shininess = glm::clamp(lobes.shininess * w, least_alpha, 1.0f);
        // The half width of cos^e is about sqrt(2 / (e + 2)).
        if (lobes.model == Model::phong) result.shininess = std::max(0.0f, (lobes.shininess + 2.0f) / (w * w) - 2.0f);
    }
    return result;
}

void change_all(std::span<const render::SurfaceLobes> own, const MaterialChange& change,
                std::span<render::SurfacePoint> points) {
    tbb::parallel_for(std::size_t{0}, own.size(),
                      [&](std::size_t i) { static_cast<render::SurfaceLobes&>(points[i]) = changed(own[i], change); });
}

}  // namespace relight
