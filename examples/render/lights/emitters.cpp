#include "lights/emitters.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <lightcuts/core/invalid_input.hpp>
#include <lightcuts/source/area.hpp>
#include <lightcuts/source/sampler.hpp>

#include "lights/emission_range.hpp"
#include "lights/scene_emitter.hpp"
#include "motion.hpp"
#include "triangle.hpp"

namespace render {
namespace {

constexpr std::size_t most_lights = 100'000'000;

/// Distance of a light from its surface, as a share of `Triangle::scale_at`: sixteen steps of a float, above the
/// rounding of the place and of an intersection there, far below what an occluder's distance may be.
constexpr float light_offset_share = 0x1p-20f;

bool is_emissive(const Scene& scene, std::size_t triangle) {
    const Material& material = scene.materials[scene.triangle_material[triangle]];
    return material.emission != glm::vec3(0.0f) && !material.only_seen;
}

/// Sets that can be united.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0u); }

    std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void unite(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        parent_[std::max(a, b)] = std::min(a, b);  // the root is the set's first member
    }

private:
    std::vector<std::uint32_t> parent_;
};

/// A corner of an emissive triangle. Adding 0 makes -0 and 0 the same.
struct Corner {
    std::uint32_t material;
    glm::vec3 position;
    std::uint32_t member;

    auto key() const { return std::tuple(material, position.x + 0.0f, position.y + 0.0f, position.z + 0.0f); }
};

}  // namespace

std::vector<EmissiveSurface> emissive_surfaces(const Scene& scene) {
    std::vector<std::uint32_t> emissive;
    std::vector<Corner> corners;
    for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
        if (!is_emissive(scene, t)) continue;
        const auto member = static_cast<std::uint32_t>(emissive.size());
        for (int i = 0; i < 3; ++i) {
            corners.push_back({scene.triangle_material[t], scene.positions[scene.triangles[t][i]], member});
        }
        emissive.push_back(static_cast<std::uint32_t>(t));
    }
    std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) { return a.key() < b.key(); });
    DisjointSets sets(emissive.size());
    for (std::size_t i = 1; i < corners.size(); ++i) {
        if (corners[i].key() == corners[i - 1].key()) sets.unite(corners[i].member, corners[i - 1].member);
    }

    std::vector<EmissiveSurface> surfaces;
    std::vector<std::size_t> surface_of(emissive.size());
    for (std::uint32_t i = 0; i < emissive.size(); ++i) {
        const std::uint32_t root = sets.find(i);
        if (root == i) {
            surface_of[i] = surfaces.size();
            surfaces.push_back({scene.triangle_material[emissive[i]], {}});
        }
        surfaces[surface_of[root]].triangles.push_back(emissive[i]);
    }
    return surfaces;
}

namespace {

std::size_t sides_of(const Scene& scene, const EmissiveSurface& surface) {
    return scene.materials[surface.material].double_sided ? 2 : 1;
}

/// Looks at what surfaces emit: of very many, at each less exactly, so that all together are as good, and load as fast.
class SurfaceSamplers {
public:
    using Sampler = lightcuts::EmitterSampler<SceneEmitter>;

    /// `scene` must outlive this object.
    SurfaceSamplers(const Scene& scene, const std::vector<std::uint32_t>& materials, std::size_t surfaces)
        : scene_(scene), range_(scene, materials) {
        constexpr double many_surfaces = 1000.0;
        constexpr std::size_t least_cuts = 4096;
        usual_.tolerance *= std::sqrt(std::max(static_cast<double>(surfaces) / many_surfaces, 1.0));
        usual_.most_cuts = std::max(usual_.most_cuts / std::max<std::size_t>(surfaces, 1), least_cuts);
    }

    /// Sum of channels of radiance x area on one side; to within 5 % where it varies.
    double power(const EmissiveSurface& surface) const {
        lightcuts::EmissionAccuracy accuracy = usual_;
        accuracy.pieces = 16;
        accuracy.tolerance = 0.05;
        const SceneEmitter emitter(scene_, range_, surface.triangles);
        return Sampler(emitter, accuracy).power();
    }

    /// Of the fronts: `count` samples of equal power, none iff nothing is emitted.
    std::vector<lightcuts::EmitterSample<>> samples(const EmissiveSurface& surface, std::size_t count) {
        // Fewer pieces where so few lights are wanted that there must be very many emitters.
        lightcuts::EmissionAccuracy accuracy = usual_;
        accuracy.pieces = std::max(4 * count, std::min(256 * count, accuracy.pieces));
        const SceneEmitter emitter(scene_, range_, surface.triangles);
        const Sampler sampler(emitter, accuracy);
        largest_error_ = std::max(largest_error_, sampler.relative_error());
        return sampler.samples(count, lightcuts::CenteredRecurrence{});
    }

    const EmissionRange& range() const { return range_; }
    /// Of what was sampled.
    double largest_error() const { return largest_error_; }

private:
    const Scene& scene_;
    EmissionRange range_;
    lightcuts::EmissionAccuracy usual_;
    double largest_error_ = 0;
};

/// The most lights in all, of the sides of surfaces that emit; 0: any number.
std::size_t total_of(const EmitterLightOptions& options, std::size_t sides) {
    constexpr std::size_t usual_total = 200'000;
    constexpr std::size_t usual_points = 64;
    return options.total.value_or(sides > usual_total / usual_points ? usual_total : 0);
}

/// Lights on each side of each surface: `options.points`, or so many that they are about `options.total` in all.
std::vector<std::size_t> points_of(const Scene& scene, const SurfaceSamplers& samplers,
                                   const std::vector<EmissiveSurface>& surfaces, const EmitterLightOptions& options) {
    std::vector<std::size_t> points(surfaces.size(), options.points);
    std::size_t sides = 0;
    for (const EmissiveSurface& surface : surfaces) sides += sides_of(scene, surface);
    const std::size_t total = total_of(options, sides);
    if (total == 0 || sides <= total / options.points) return points;

    // One factor of all powers, within the least and the most that a surface may have.
    std::vector<double> powers;
    powers.reserve(surfaces.size());
    for (const EmissiveSurface& surface : surfaces) powers.push_back(samplers.power(surface));
    const auto set_by = [&](double factor) {
        std::size_t sum = 0;
        for (std::size_t i = 0; i < surfaces.size(); ++i) {
            const double most = static_cast<double>(options.points);
            points[i] = static_cast<std::size_t>(std::clamp(factor * powers[i], 1.0, most));
            sum += points[i] * sides_of(scene, surfaces[i]);
        }
        return sum;
    };
    const double largest = *std::max_element(powers.begin(), powers.end());
    if (!(largest > 0.0)) return points;
    double low = 0.0;
    double high = static_cast<double>(options.points) * static_cast<double>(surfaces.size()) / largest;
    while (set_by(high) <= total && high < 1e300) high *= 2.0;
    for (int step = 0; step < 60; ++step) {
        const double middle = 0.5 * (low + high);
        (set_by(middle) <= total ? low : high) = middle;
    }
    set_by(low);
    return points;
}

/// The most instants at which parts of the surface have lights of their own.
std::size_t instants_of(const Scene& scene, const EmissiveSurface& surface) {
    const bool any = std::any_of(surface.triangles.begin(), surface.triangles.end(),
                                 [&](std::uint32_t t) { return moves(scene, t); });
    return any ? scene.instants.size() : 1;
}

/// The light of a sample on `triangle`, and that on its other side.
std::vector<lightcuts::OrientedPointLight<>> lights_of(const lightcuts::EmitterSample<>& sample,
                                                       const Triangle& triangle, bool both_sides) {
    const glm::vec3 p = sample.position;
    const glm::vec3 n = sample.normal;
    const float offset = light_offset_share * static_cast<float>(triangle.scale_at(glm::dvec3(p)));
    std::vector<lightcuts::OrientedPointLight<>> lights{{p + offset * n, n, sample.intensity}};
    if (both_sides) lights.push_back({p - offset * n, -n, sample.intensity});
    return lights;
}

/// Barycentric coordinates (u, v) of a point of the triangle.
glm::dvec2 place_in(const Triangle& triangle, const glm::dvec3& p) {
    const glm::dvec3 cross = triangle.cross();
    const double square = glm::dot(cross, cross);
    const double u = glm::dot(glm::cross(p - triangle.a, triangle.c - triangle.a), cross) / square;
    const double v = glm::dot(glm::cross(triangle.b - triangle.a, p - triangle.a), cross) / square;
    return {u, v};
}

/// Adds the lights of a sample on a triangle that moves, where it is at each instant. One that grows shines more.
void add_at_instants(Scene& scene, const lightcuts::EmitterSample<>& sample, std::uint32_t moving, bool both_sides) {
    const Triangle opening(scene, moving);
    const glm::dvec2 place = place_in(opening, glm::dvec3(sample.position));
    for (std::uint32_t t = 0; t < scene.instants.size(); ++t) {
        const Triangle triangle = triangle_at(scene, moving, scene.instants[t]);
        if (!(triangle.area() > 0.0)) continue;
        lightcuts::EmitterSample<> there = sample;
        there.position = glm::vec3(triangle.at(place));
        there.normal = glm::vec3(glm::normalize(triangle.cross()));
        there.intensity *= static_cast<float>(triangle.area() / opening.area());
        for (const auto& light : lights_of(there, triangle, both_sides)) {
            scene.at_instants.oriented.push_back({light, t});
        }
    }
}

/// The materials of `surfaces`, each once.
std::vector<std::uint32_t> materials_of(const std::vector<EmissiveSurface>& surfaces) {
    std::vector<std::uint32_t> materials;
    for (const EmissiveSurface& surface : surfaces) materials.push_back(surface.material);
    std::sort(materials.begin(), materials.end());
    materials.erase(std::unique(materials.begin(), materials.end()), materials.end());
    return materials;
}

/// Notes materials that emit by their factors and maps, but nowhere on their surfaces, and maps that are too fine.
void note_what_is_lost(Scene& scene, const SurfaceSamplers& samplers, const std::vector<std::uint32_t>& materials,
                       const std::vector<bool>& has_lights) {
    constexpr double large_error = 0.01;
    for (const std::uint32_t m : materials) {
        const Material& material = scene.materials[m];
        if (has_lights[m] || !samplers.range().is_lit(material)) continue;
        leave_out(scene.left_out, "the light of the material '" + material.name + "'",
                  "its surfaces show no part of its emission map that is bright, or are not there where it is");
    }
    if (samplers.largest_error() > large_error) {
        std::ostringstream why;
        why << "what an emission map shows is too fine; its surface's light may be off by "
            << 100.0 * samplers.largest_error() << " %";
        leave_out(scene.left_out, "details of emission", why.str());
    }
}

}  // namespace

void add_emitter_lights(Scene& scene, const EmitterLightOptions& options) {
    if (options.points == 0) return;
    const std::vector<EmissiveSurface> surfaces = emissive_surfaces(scene);
    const std::vector<std::uint32_t> materials = materials_of(surfaces);
    SurfaceSamplers samplers(scene, materials, surfaces.size());
    const std::vector<std::size_t> points = points_of(scene, samplers, surfaces, options);
    std::size_t all = 0;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        all += points[i] * sides_of(scene, surfaces[i]) * instants_of(scene, surfaces[i]);
    }
    if (all > most_lights) {
        throw lightcuts::invalid_input(scene.name + ": " + std::to_string(all) + " lights on " +
                                       std::to_string(surfaces.size()) +
                                       " emissive surfaces are too many; lower --area-points or --area-lights");
    }
    std::vector<bool> has_lights(scene.materials.size());
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const EmissiveSurface& surface = surfaces[i];
        const bool both_sides = sides_of(scene, surface) == 2;
        for (const lightcuts::EmitterSample<>& sample : samplers.samples(surface, points[i])) {
            const std::uint32_t triangle = surface.triangles[sample.triangle];
            has_lights[surface.material] = true;
            if (moves(scene, triangle)) {
                add_at_instants(scene, sample, triangle, both_sides);
                continue;
            }
            for (const auto& light : lights_of(sample, Triangle(scene, triangle), both_sides)) {
                scene.oriented.push_back(light);
            }
        }
    }
    note_what_is_lost(scene, samplers, materials, has_lights);
}

}  // namespace render
