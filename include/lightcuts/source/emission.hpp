#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "../core/basis.hpp"
#include "../core/box.hpp"
#include "../light/incidence.hpp"

namespace lightcuts::detail {

/// The ray along which a particle leaves its light.
struct EmittedRay {
    glm::dvec3 origin;
    glm::dvec3 direction;  ///< unit
};

/// Emission about an axis, tabulated as constant over equal steps of the angle.
class TabulatedEmission {
public:
    template <ProfiledLight L>
    explicit TabulatedEmission(const L& light) {
        double before = 1.0;
        for (std::size_t i = 0; i < steps; ++i) {
            const double angle = std::numbers::pi * static_cast<double>(i) / steps;
            const double cosine = std::cos(angle + std::numbers::pi / steps);
            const auto middle = static_cast<float>(std::cos(angle + 0.5 * std::numbers::pi / steps));
            const double emission = static_cast<double>(emission_of(light, middle));
            power_ += emission > 0.0 ? emission * 2.0 * std::numbers::pi * (before - cosine) : 0.0;
            until_[i] = power_;
            before = cosine;
        }
    }
    /// Flux of a light of intensity 1.
    double power() const { return power_; }
    /// The cosine above which `u` of the power lies. pre: power() > 0
    double cosine(double u) const {
        const auto found = std::upper_bound(until_.begin(), until_.end() - 1, u * power_);
        const auto i = static_cast<std::size_t>(found - until_.begin());
        const double start = i > 0 ? until_[i - 1] : 0.0;
        const double inside = (u * power_ - start) / (until_[i] - start);
        const double angle = std::numbers::pi / steps;
        return glm::mix(std::cos(angle * static_cast<double>(i)), std::cos(angle * static_cast<double>(i + 1)), inside);
    }

    /// Some order, in which equal tables are neither before nor behind each other.
    friend bool operator<(const TabulatedEmission& a, const TabulatedEmission& b) { return a.until_ < b.until_; }

private:
    static constexpr std::size_t steps = 512;
    std::array<double, steps> until_;
    double power_ = 0.0;
};

/// Areas of the three faces of `bounds` that light along `direction` enters by, seen along it.
inline glm::dvec3 entered_faces(const Box& bounds, const glm::dvec3& direction) {
    const glm::dvec3 size = extent(bounds);
    return glm::abs(direction) * glm::dvec3(size.y * size.z, size.z * size.x, size.x * size.y);
}

/// What `light` sends into a scene within `bounds`, for intensity 1: flux over intensity, sr; of a directional light
/// the area of the bounds' outline, m^2. Of a light with a profile see TabulatedEmission.
template <Light L>
    requires(!ProfiledLight<L>)
double flux_factor(const L& light, const Box& bounds) {
    if constexpr (DirectionalLight<L>) {
        const glm::dvec3 faces = entered_faces(bounds, -glm::dvec3(position_or_direction(light)));
        return faces.x + faces.y + faces.z;
    } else if constexpr (OrientedLight<L>) {
        return std::numbers::pi;
    } else {
        return 4.0 * std::numbers::pi;
    }
}

/// A particle of a directional light: with (u, v) and w uniform, particles enter `bounds` evenly.
inline EmittedRay parallel_ray(const glm::dvec3& direction, const Box& bounds, const glm::dvec2& uv, double w) {
    const glm::dvec3 faces = entered_faces(bounds, direction);
    const double at = w * (faces.x + faces.y + faces.z);
    const int axis = at < faces.x ? 0 : at < faces.x + faces.y ? 1 : 2;
    glm::dvec3 point(bounds.lo);
    const glm::dvec3 size = extent(bounds);
    point[axis] = static_cast<double>(direction[axis] > 0.0 ? bounds.lo[axis] : bounds.hi[axis]);
    point[(axis + 1) % 3] += uv.x * size[(axis + 1) % 3];
    point[(axis + 2) % 3] += uv.y * size[(axis + 2) % 3];
    // From outside, for surfaces that lie in the face.
    return {point - 0.01 * std::sqrt(diagonal2(bounds)) * direction, direction};
}

/// A particle of `light`: with (u, v) and w uniform, particles leave with the density of its emission. `profile`: the
/// emission of a light that has one.
template <Light L>
EmittedRay emitted_ray(const L& light, const TabulatedEmission* profile, const Box& bounds, const glm::dvec2& uv,
                       double w) {
    const glm::dvec3 place(position_or_direction(light));
    if constexpr (DirectionalLight<L>) {
        return parallel_ray(-place, bounds, uv, w);
    } else if constexpr (OrientedLight<L>) {
        const glm::dvec3 axis = glm::normalize(glm::dvec3(to_vec3(axis_of(light))));
        const double cosine = ProfiledLight<L> ? profile->cosine(uv.x) : std::sqrt(1.0 - uv.x);
        return {place, Basis(axis).out(around_z(cosine, uv.y))};
    } else {
        return {place, around_z(1.0 - 2.0 * uv.x, uv.y)};
    }
}

}  // namespace lightcuts::detail
