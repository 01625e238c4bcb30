#include "bounce.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include <oneapi/tbb/parallel_for.h>
#include <glm/geometric.hpp>
#include <lightcuts/core/basis.hpp>
#include <lightcuts/core/invalid_input.hpp>
#include <lightcuts/core/random.hpp>
#include <lightcuts/piecewise/even_directions.hpp>
#include <render/surfaces/surface_colors.hpp>
#include <render/surfaces/surface_geometry.hpp>

#include "visibility.hpp"

namespace daylighting {
namespace {

constexpr int most_panes = 16;  ///< that a ray passes
constexpr std::size_t most_points = 1'000'000;
/// At so many spacings cells are as wide as the spacing; then their width grows with the distance.
constexpr double near_spacings = 16.0;
constexpr float aligned = 0.9962f;  ///< cosine of 5 degrees

/// What a ray met that reflects light.
struct Reflector {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};
    float distance = 0.0f;
    float reflectance = 0.0f;  ///< 0: nothing
};

float mean(const glm::vec3& color) { return (color.r + color.g + color.b) * (1.0f / 3.0f); }

Reflector reflector_along(const render::Scene& scene, const render::RayScene& rays, glm::vec3 from,
                          const glm::vec3& direction) {
    Reflector found;
    float passed = 1.0f;
    for (int pane = 0; pane < most_panes && passed > 0.0f; ++pane) {
        const auto hit = rays.nearest(from, direction);
        if (!hit) return {};
        const render::SurfaceGeometry surface = render::surface_at(scene, *hit, direction);
        const render::SurfaceColors colors = render::colors_at(scene, hit->triangle, hit->u, hit->v);
        found.distance += hit->distance;
        const float tint = mean(render::tint_at(scene, hit->triangle, hit->u, hit->v));
        if (tint > 0.0f) {
            passed *= tint;
            from = surface.leave(direction);
            continue;
        }
        found.position = surface.leave(surface.geometric_normal);
        found.normal = surface.geometric_normal;
        found.reflectance = passed * mean(colors.base) * (1.0f - colors.metallic);
        return found;
    }
    return {};
}

/// Where, at which level of width, and with which normal: all that is hit there is one point.
using Cell = std::array<std::int32_t, 5>;

/// What a sensor sees of a cell.
struct SeenCell {
    Cell cell;
    glm::vec3 position;  ///< of its first ray there
    float share;         ///< of its illuminance that comes to the sensor
};

/// The normals that points may have.
class Normals {
public:
    Normals() : all_{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}} {
        for (const glm::vec3& n : lightcuts::even_directions(128)) all_.push_back(n);
    }
    const glm::vec3& operator[](std::int32_t i) const { return all_[static_cast<std::size_t>(i)]; }
    std::int32_t nearest(const glm::vec3& normal) const {
        std::size_t best = 0;
        for (std::size_t i = 0; i < all_.size(); ++i) {
            if (i == axes && glm::dot(all_[best], normal) > aligned) break;
            if (glm::dot(all_[i], normal) > glm::dot(all_[best], normal)) best = i;
        }
        return static_cast<std::int32_t>(best);
    }

private:
    static constexpr std::size_t axes = 6;
    std::vector<glm::vec3> all_;
};

}  // namespace

Bounce find_bounce(const render::Scene& scene, const render::RayScene& rays, std::span<const Sensor> sensors,
                   const BounceSettings& settings) {
    const RayStarts starts(scene);
    const Normals normals;
    const auto cell_of = [&](const Reflector& r) -> Cell {
        const double far = static_cast<double>(r.distance) / (near_spacings * settings.spacing);
        const int level = far > 1.0 ? static_cast<int>(std::log2(far)) : 0;
        const glm::dvec3 cell = glm::dvec3(r.position) / std::ldexp(settings.spacing, level);
        const auto at = [](double x) { return static_cast<std::int32_t>(std::floor(std::clamp(x, -2e9, 2e9))); };
        return {at(cell.x), at(cell.y), at(cell.z), level, normals.nearest(r.normal)};
    };
    const auto seen_from = [&](std::size_t s, std::vector<SeenCell>& seen) {
        const Sensor& sensor = sensors[s];
        const lightcuts::Basis frame{glm::dvec3(sensor.normal)};
        const glm::vec3 from = starts(sensor);
        const double turn = lightcuts::uniform01(lightcuts::hash_keys(s, 0)),
                     shift = lightcuts::uniform01(lightcuts::hash_keys(s, 1));
        seen.clear();
        for (std::uint32_t k = 0; k < settings.rays; ++k) {
            // A spiral over the disc below the hemisphere, turned by chance.
            const double share = (k + shift) / settings.rays;
            const glm::vec3 direction(
                frame.out(lightcuts::around_z(std::sqrt(1.0 - share), k * (2.0 - std::numbers::phi) + turn)));
            const Reflector r = reflector_along(scene, rays, from, direction);
            if (r.reflectance > 0.0f) {
                seen.push_back({cell_of(r), r.position, r.reflectance / static_cast<float>(settings.rays)});
            }
        }
        std::stable_sort(seen.begin(), seen.end(),
                         [](const SeenCell& a, const SeenCell& b) { return a.cell < b.cell; });
        std::size_t last = 0;
        for (std::size_t i = 1; i < seen.size(); ++i) {
            if (seen[i].cell == seen[last].cell) {
                seen[last].share += seen[i].share;
            } else {
                seen[++last] = seen[i];
            }
        }
        if (!seen.empty()) seen.resize(last + 1);
    };

    // Sensors at once, and then points in the sensors' order.
    constexpr std::size_t batch = 256;
    std::vector<std::vector<SeenCell>> seen(batch);
    std::map<Cell, std::uint32_t> known;
    Bounce bounce;
    for (std::size_t first = 0; first < sensors.size(); first += batch) {
        const std::size_t count = std::min(batch, sensors.size() - first);
        tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { seen_from(first + i, seen[i]); });
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t begin = bounce.links.size();
            for (const SeenCell& cell : seen[i]) {
                const auto next = static_cast<std::uint32_t>(bounce.points.size());
                const auto [at, is_new] = known.try_emplace(cell.cell, next);
                if (is_new) {
                    if (bounce.points.size() == most_points) {
                        throw lightcuts::invalid_input("--bounce: more than " + std::to_string(most_points) +
                                                       " points; give a larger spacing");
                    }
                    bounce.points.push_back({glm::dvec3(cell.position) + scene.origin, normals[cell.cell.back()]});
                }
                bounce.links.push_back({at->second, cell.share});
            }
            std::sort(bounce.links.begin() + static_cast<std::ptrdiff_t>(begin), bounce.links.end(),
                      [](const Bounce::Link& a, const Bounce::Link& b) { return a.point < b.point; });
            bounce.ends.push_back(bounce.links.size());
        }
    }
    return bounce;
}

void add_bounce(const Bounce& bounce, Illuminances& lux) {
    const std::size_t count = bounce.ends.size();
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t s) {
        const std::span<float> to = lux.of(s);
        for (const Bounce::Link& link : bounce.of(s)) {
            const std::span<const float> from = std::as_const(lux).of(count + link.point);
            for (std::size_t h = 0; h < to.size(); ++h) to[h] += link.share * from[h];
        }
    });
}

}  // namespace daylighting
