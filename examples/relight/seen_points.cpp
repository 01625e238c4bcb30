#include "seen_points.hpp"

#include <oneapi/tbb/parallel_for.h>

namespace relight {

SeenPoints see(const render::Scene& scene, const render::RayScene& rays, const render::View& view, int spp,
               std::uint64_t seed, render::Shade shade) {
    const render::EyePathTracer tracer(scene, rays, shade);
    SeenPoints seen;
    seen.width = view.width();
    seen.height = view.height();
    seen.emitted.assign(static_cast<std::size_t>(seen.width) * static_cast<std::size_t>(seen.height), glm::vec3(0.0f));
    struct Row {
        std::vector<render::SurfacePoint> points;
        std::vector<render::Escape> escapes;
    };
    std::vector<Row> rows(static_cast<std::size_t>(seen.height));
    const float share = 1.0f / static_cast<float>(spp);
    tbb::parallel_for(0, seen.height, [&](int y) {
        Row& row = rows[static_cast<std::size_t>(y)];
        for (int x = 0; x < seen.width; ++x) {
            const auto pixel = static_cast<std::uint32_t>(y * seen.width + x);
            for (int sample = 0; sample < spp; ++sample) {
                const glm::vec2 offset = render::pixel_offset(seed, pixel, sample, spp);
                const render::EyeRay ray = view.ray(static_cast<float>(x) + offset.x, static_cast<float>(y) + offset.y);
                const auto found = tracer.follow(ray, pixel, static_cast<std::uint32_t>(sample), row.points,
                                                 row.escapes);
                seen.emitted[pixel] += found.emitted * share;
            }
        }
        for (render::SurfacePoint& point : row.points) point.weight *= share;
        for (render::Escape& escape : row.escapes) escape.weight *= share;
    });
    for (const Row& row : rows) {
        seen.points.insert(seen.points.end(), row.points.begin(), row.points.end());
        seen.escapes.insert(seen.escapes.end(), row.escapes.begin(), row.escapes.end());
    }
    return seen;
}

}  // namespace relight
