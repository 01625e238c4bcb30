#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <lightcuts/core/random.hpp>

namespace lightcuts::test {

/// A reproducible stream of random numbers.
class Random {
public:
    explicit Random(std::uint64_t seed) : seed_(seed) {}

    std::uint64_t bits() { return hash_keys(seed_, counter_++); }
    double unit() { return uniform01(bits()); }
    double between(double lo, double hi) { return lo + (hi - lo) * unit(); }
    float real(double lo, double hi) { return static_cast<float>(between(lo, hi)); }
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(unit() * static_cast<double>(n)); }
    bool chance(double p) { return unit() < p; }
    /// 10 to a power in [lo, hi].
    double decades(double lo, double hi) { return std::pow(10.0, between(lo, hi)); }

    glm::dvec3 in_box(const glm::dvec3& lo, const glm::dvec3& hi) {
        const double x = unit(), y = unit(), z = unit();
        return lo + (hi - lo) * glm::dvec3(x, y, z);
    }
    glm::dvec3 on_sphere() {
        const double z = between(-1.0, 1.0);
        const double phi = between(0.0, 2.0 * std::numbers::pi);
        const double r = std::sqrt(1.0 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }
    /// A unit vector within `angle` of `axis`.
    glm::dvec3 near(const glm::dvec3& axis, double angle) {
        const glm::dvec3 side = on_sphere();
        const glm::dvec3 across = side - axis * glm::dot(axis, side);
        const double theta = angle * unit();
        const double length = glm::length(across);
        if (!(length > 1e-9)) return axis;
        return glm::normalize(axis * std::cos(theta) + across * (std::sin(theta) / length));
    }

private:
    std::uint64_t seed_;
    std::uint64_t counter_ = 0;
};

}  // namespace lightcuts::test
