#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <lightcuts/light/directional.hpp>
#include <lightcuts/light/omni.hpp>
#include <lightcuts/light/oriented.hpp>
#include <lightcuts/light/scattering.hpp>
#include <lightcuts/light/spot.hpp>
#include <lightcuts/material/above_horizon.hpp>
#include <lightcuts/material/ggx.hpp>
#include <lightcuts/material/lambert.hpp>
#include <lightcuts/material/phong.hpp>
#include <lightcuts/material/sum.hpp>
#include <lightcuts/material/thin_sheet.hpp>
#include <lightcuts/material/ward.hpp>
#include "support/random.hpp"

namespace lightcuts::test {

/// A receiver and some lights, random but with a taste for trouble: flat, needle-shaped and point-like sets; receivers
/// inside, touching, in the plane of the lights or at one of them; grazing normals and axes; extreme scales.
struct ClusterConfiguration {
    glm::vec3 receiver{0.0f};
    glm::vec3 normal{0.0f, 0.0f, 1.0f};
    glm::vec3 view{0.0f, 0.0f, 1.0f};
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> axes;
    std::vector<glm::vec3> intensities;
};

inline glm::dvec3 axis_or_any(Random& random) {
    constexpr std::array<glm::dvec3, 6> unit{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
    return random.chance(0.4) ? unit[random.below(6)] : random.on_sphere();
}

/// Unit and exactly or nearly perpendicular to `v`; any if v is zero.
inline glm::dvec3 grazing(Random& random, const glm::dvec3& v) {
    const glm::dvec3 side = axis_or_any(random);
    const glm::dvec3 across = glm::cross(v, side);
    const double length = glm::length(across);
    if (!(length > 0.0)) return side;
    const glm::dvec3 exact = across / length;
    const double size = glm::length(v);
    const double tilt = random.chance(0.4) ? 0.0 : random.decades(-12.0, -1.0) * (random.chance(0.5) ? 1.0 : -1.0);
    return glm::normalize(exact + v * (tilt / size));
}

inline double some_spread(Random& random) {
    switch (random.below(7)) {
        case 0: return 0.0;
        case 1: return random.decades(-7.0, -3.0);
        case 2: return random.between(0.01, 0.2);
        case 3: return random.between(0.2, 1.2);
        case 4: return 0.5 * std::numbers::pi;
        case 5: return std::numbers::pi;
        default: return 0.0;
    }
}

inline ClusterConfiguration random_configuration(Random& random) {
    ClusterConfiguration c;
    // Step 1: a box about the origin, of size 1 or less in each direction.
    glm::dvec3 half(random.between(0.05, 1.0), random.between(0.05, 1.0), random.between(0.05, 1.0));
    for (int a = 0; a < 3; ++a) {
        const double p = random.unit();
        if (p < 0.2)
            half[a] = 0.0;
        else if (p < 0.35)
            half[a] *= 1e-6;
    }
    if (random.chance(0.1)) half = glm::dvec3(0.0);

    // Step 2: a receiver relative to it.
    glm::dvec3 x(0.0);
    switch (random.below(8)) {
        case 0: x = random.on_sphere() * random.between(20.0, 200.0); break;
        case 1:
        case 2: x = random.on_sphere() * random.between(1.8, 6.0); break;
        case 3: x = random.in_box(-1.2 * half, 1.2 * half); break;
        case 4:  // in the plane of a face, or on it
            x = random.in_box(-3.0 * half, 3.0 * half);
            x[static_cast<int>(random.below(3))] = half.x;
            break;
        case 5: {  // along an axis through a corner
            x = half;
            x[static_cast<int>(random.below(3))] += random.decades(-6.0, 1.0);
            break;
        }
        case 6:  // at a corner, or nearly
            x = half + random.on_sphere() * (random.chance(0.5) ? 0.0 : random.decades(-20.0, -1.0));
            break;
        default: x = axis_or_any(random) * random.between(0.0, 3.0); break;
    }

    // Step 3: lights at its corners and inside.
    const std::size_t count = 1 + random.below(6);
    std::vector<glm::dvec3> p;
    for (std::size_t i = 0; i < count; ++i) {
        if (random.chance(0.6)) {
            p.push_back({random.chance(0.5) ? -half.x : half.x, random.chance(0.5) ? -half.y : half.y,
                         random.chance(0.5) ? -half.z : half.z});
        } else {
            p.push_back(random.in_box(-half, half));
        }
    }
    if (random.chance(0.05)) p.back() = x;

    // Step 4: scale and offset.
    constexpr std::array<double, 9> scales{1.0, 1.0, 1.0, 1.0, 1e-3, 1e3, 1e-12, 1e12, 37.0};
    const double scale = scales[random.below(scales.size())];
    glm::dvec3 offset(0.0);
    if (random.chance(0.15)) offset = random.on_sphere() * (random.chance(0.5) ? 1e6 : 3.0) * scale;
    c.receiver = glm::vec3(x * scale + offset);
    for (const glm::dvec3& q : p) c.positions.push_back(glm::vec3(q * scale + offset));

    // Step 5: normal, view and axes, often where a cosine vanishes for one of the lights.
    const glm::dvec3 target = glm::dvec3(c.positions[random.below(count)]) - glm::dvec3(c.receiver);
    const double distance = glm::length(target);
    const glm::dvec3 towards = distance > 0.0 ? target / distance : random.on_sphere();
    glm::dvec3 n(0.0);
    switch (random.below(4)) {
        case 0: n = axis_or_any(random); break;
        case 1: n = grazing(random, towards); break;
        case 2: n = random.near(towards, 0.5); break;
        default: n = random.near(towards, 1.6); break;
    }
    c.normal = glm::vec3(glm::normalize(n));
    const glm::dvec3 unit_n = glm::normalize(glm::dvec3(c.normal));
    glm::dvec3 view = random.near(unit_n, 1.57);
    if (random.chance(0.15)) view = grazing(random, unit_n);
    if (random.chance(0.2)) view = glm::normalize(2.0 * glm::dot(unit_n, towards) * unit_n - towards);
    if (random.chance(0.05)) view = unit_n;
    c.view = glm::vec3(glm::normalize(view));

    const double spread = some_spread(random);
    glm::dvec3 u(0.0);
    switch (random.below(4)) {
        case 0: u = axis_or_any(random); break;
        case 1: u = grazing(random, towards); break;
        case 2: u = random.near(-towards, 0.5); break;
        default: u = random.near(-towards, std::fmin(1.7 + spread, 3.0)); break;
    }
    const bool all_but_one_away = random.chance(0.2);
    const bool sloppy_axes = random.chance(0.1);
    for (std::size_t i = 0; i < count; ++i) {
        const bool at_rim = spread > 0.0 && random.chance(0.4);
        glm::dvec3 axis = spread > 0.0 ? random.near(u, spread) : u;
        if (at_rim && spread < 3.0) {
            const glm::dvec3 side = random.chance(0.5) ? -towards - u * glm::dot(-towards, u) : random.on_sphere();
            const glm::dvec3 across = side - u * glm::dot(u, side);
            const double rise = glm::length(across);
            if (rise > 1e-9) axis = u * std::cos(spread) + across * (std::sin(spread) / rise);
        }
        if (spread == std::numbers::pi && i == 1) axis = -u;
        if (spread > 0.0 && all_but_one_away) { axis = i == 0 ? grazing(random, towards) : random.near(towards, 1.5); }
        // Of unit length as far as trees insist on it.
        const double length = sloppy_axes ? random.between(1.0 - 4e-6, 1.0 + 4e-6) : 1.0;
        c.axes.push_back(glm::vec3(glm::normalize(axis) * length));
        glm::dvec3 intensity(random.unit(), random.unit(), random.unit());
        if (random.chance(0.2)) intensity[static_cast<int>(random.below(3))] = 0.0;
        if (random.chance(0.1)) intensity *= random.decades(-44.0, 30.0);
        c.intensities.push_back(glm::vec3(intensity));
    }
    return c;
}

/// An IES-like profile of the user's: bright along the axis and in a ring, dark between, with a step.
/// It states a bound for all lights of its kind.
struct RingLight {
    glm::vec3 position;
    glm::vec3 axis;
    glm::vec3 intensity;

    static float emission(float cosine) {
        if (cosine > 0.9f) return 0.7f;
        const float ring = 1.0f - 40.0f * (cosine - 0.3f) * (cosine - 0.3f);
        return ring > 0.0f ? ring : 0.0f;
    }
    static float emission_bound(float cos_min, float cos_max) {
        float most = cos_max > 0.9f ? 0.7f : 0.0f;
        const float nearest = cos_min > 0.3f ? cos_min : cos_max < 0.3f ? cos_max : 0.3f;
        const float ring = emission(nearest > 0.9f ? 0.9f : nearest);
        return ring > most ? ring : most;
    }
};

template <class L>
struct LightMaker {
    /// `i`-th light of a configuration.
    static L make(Random&, const ClusterConfiguration& c, std::size_t i) {
        if constexpr (DirectionalLight<L>) {
            return {c.axes[i], c.intensities[i]};
        } else if constexpr (OrientedLight<L>) {
            return {c.positions[i], c.axes[i], c.intensities[i]};
        } else {
            return {c.positions[i], c.intensities[i]};
        }
    }
};

inline PolynomialFalloff random_falloff(Random& random) {
    const auto coefficient = [&] { return random.chance(0.3) ? 0.0f : static_cast<float>(random.decades(-3.0, 1.0)); };
    PolynomialFalloff f{coefficient(), coefficient(), coefficient()};
    if (f.constant + f.linear + f.quadratic == 0.0f) f.quadratic = 1.0f;
    return f;
}

template <>
struct LightMaker<OmniLight<glm::vec3, PolynomialFalloff>> {
    static OmniLight<glm::vec3, PolynomialFalloff> make(Random& random, const ClusterConfiguration& c, std::size_t i) {
        return {c.positions[i], c.intensities[i], random_falloff(random)};
    }
};

template <>
struct LightMaker<OrientedPointLight<glm::vec3, PolynomialFalloff>> {
    static OrientedPointLight<glm::vec3, PolynomialFalloff> make(Random& random, const ClusterConfiguration& c,
                                                                 std::size_t i) {
        return {c.positions[i], c.axes[i], c.intensities[i], random_falloff(random)};
    }
};

template <>
struct LightMaker<SpotLight<>> {
    static SpotLight<> make(Random& random, const ClusterConfiguration& c, std::size_t i) {
        const double outer = random.between(0.05, 1.57);
        const double inner = outer * (random.chance(0.3) ? 0.999 : random.unit());
        SpotProfile profile{static_cast<float>(std::cos(inner)), static_cast<float>(std::cos(outer))};
        if (!(profile.cos_outer < profile.cos_inner)) profile = {};
        return {c.positions[i], c.axes[i], c.intensities[i], profile};
    }
};

template <>
struct LightMaker<ScatteringPointLight<>> {
    static ScatteringPointLight<> make(Random& random, const ClusterConfiguration& c, std::size_t i) {
        const double narrow = random.chance(0.2) ? 1.0 : random.chance(0.5) ? random.unit() : random.decades(-4.0, 0.0);
        const auto asymmetry = static_cast<float>(1.0 - narrow);
        return {c.positions[i], c.axes[i], c.intensities[i], {asymmetry}};
    }
};

template <class M>
struct MaterialMaker;

inline glm::vec3 random_albedo(Random& random) {
    return {random.real(0.0, 1.0), random.chance(0.1) ? 0.0f : random.real(0.0, 1.0), random.real(0.0, 1.0)};
}

template <>
struct MaterialMaker<Lambert<glm::vec3>> {
    static Lambert<glm::vec3> make(Random& random, const glm::vec3& n, const glm::vec3&) {
        return {n, random_albedo(random)};
    }
};
template <>
struct MaterialMaker<ModifiedPhong<glm::vec3>> {
    static ModifiedPhong<glm::vec3> make(Random& random, const glm::vec3& n, const glm::vec3& view) {
        const float exponent = random.chance(0.2) ? 0.0f : static_cast<float>(random.decades(0.0, 6.0));
        return {n, view, random_albedo(random), exponent};
    }
};
template <class Normalization>
struct MaterialMaker<Ward<glm::vec3, Normalization>> {
    static Ward<glm::vec3, Normalization> make(Random& random, const glm::vec3& n, const glm::vec3& view) {
        return {n, view, random_albedo(random), static_cast<float>(random.decades(-3.0, 0.0))};
    }
};
template <class Shadowing>
struct MaterialMaker<Ggx<glm::vec3, Shadowing>> {
    static Ggx<glm::vec3, Shadowing> make(Random& random, const glm::vec3& n, const glm::vec3& view) {
        return {n, view, random_albedo(random), static_cast<float>(random.decades(-3.0, 0.3))};
    }
};
using DiffuseAndGlossy = Sum<Lambert<glm::vec3>, Ggx<glm::vec3>>;
template <>
struct MaterialMaker<DiffuseAndGlossy> {
    static DiffuseAndGlossy make(Random& random, const glm::vec3& n, const glm::vec3& view) {
        return DiffuseAndGlossy(MaterialMaker<Lambert<glm::vec3>>::make(random, n, view),
                                MaterialMaker<Ggx<glm::vec3>>::make(random, n, view));
    }
};
template <class M>
struct MaterialMaker<AboveHorizon<M>> {
    static AboveHorizon<M> make(Random& random, const glm::vec3& n, const glm::vec3& view) {
        const double tilt = random.chance(0.2) ? 0.0 : 0.6;
        const glm::vec3 geometric(random.near(glm::normalize(glm::dvec3(n)), tilt));
        return {MaterialMaker<M>::make(random, n, view), geometric};
    }
};
using Leaf = ThinSheet<DiffuseAndGlossy, Lambert<glm::vec3>>;
template <>
struct MaterialMaker<Leaf> {
    static Leaf make(Random& random, const glm::vec3& n, const glm::vec3& view) {
        const AboveHorizon<DiffuseAndGlossy> front = MaterialMaker<AboveHorizon<DiffuseAndGlossy>>::make(random, n,
                                                                                                         view);
        return {front.material, MaterialMaker<Lambert<glm::vec3>>::make(random, -n, -view), front.geometric_normal};
    }
};

}  // namespace lightcuts::test
