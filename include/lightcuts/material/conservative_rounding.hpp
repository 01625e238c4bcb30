#pragma once

#include <cmath>
#include <cstddef>
#include <limits>

#include <glm/vec3.hpp>

#include "../core/box.hpp"
#include "../core/offset_block.hpp"
#include "../core/spectrum.hpp"
#include "../core/vectorized.hpp"
#include "material.hpp"

namespace lightcuts::detail {

/// How far evaluate() may see a light from where it is: normalizing the float difference of two positions changes each
/// coordinate by at most 3 relative float roundoffs, apart from a factor common to all. Also the angle, in radians,
/// that this amounts to at most.
inline constexpr double direction_error = 16.0 * 0x1p-24;

/// A box that also holds the offsets whose directions are those of `b` as rounded to float. Zeros stay zeros.
inline OffsetBox rounded_directions(const OffsetBox& b) {
    const auto margin = [](double x) { return direction_error * std::fabs(x); };
    return {{b.lo.x - margin(b.lo.x), b.lo.y - margin(b.lo.y), b.lo.z - margin(b.lo.z)},
            {b.hi.x + margin(b.hi.x), b.hi.y + margin(b.hi.y), b.hi.z + margin(b.hi.z)}};
}

/// True only if n . p > 0 for no point of `b`, its direction rounded to float. Twice the `error` allows for a dot
/// product in float too.
inline bool lies_below(const glm::dvec3& n, const OffsetBox& b, double error = direction_error) {
    const double x = n.x * (n.x > 0.0 ? b.hi.x : b.lo.x);
    const double y = n.y * (n.y > 0.0 ? b.hi.y : b.lo.y);
    const double z = n.z * (n.z > 0.0 ? b.hi.z : b.lo.z);
    return x + y + z <= -error * (std::fabs(x) + std::fabs(y) + std::fabs(z));
}

/// Blackens the bounds of boxes for which n . p > 0 holds nowhere, directions rounded to float. `n`: a unit vector
/// within float rounding.
template <Spectrum S>
LIGHTCUTS_VECTORIZED void blacken_below(const glm::vec3& n, const OffsetBlock& offsets, LaneSpectra<S>& bounds) {
    LaneSupport s;
    support(n, offsets, s);
    for (int i = 0; i < lane_count; ++i) {
        if (s.value[i] <= -s.noise[i]) bounds[static_cast<std::size_t>(i)] = black<S>();
    }
}

/// The largest cosine after the direction has turned by `direction_error`. pre: 0 <= c <= 1
inline double perturbed_cosine(double c) {
    const double raised = c + direction_error * std::sqrt((1.0 - c) * (1.0 + c));
    return raised < 1.0 ? raised : 1.0;
}

/// A bound's last step: x with room for the rounding of evaluate(), of the bound's own arithmetic and of what follows
/// in float; at least the smallest normal float. pre: x >= 0
inline float with_rounding_margin(double x) {
    constexpr float smallest = (std::numeric_limits<float>::min)();
    const auto raised = static_cast<float>(x * (1.0 + 5e-5));
    return raised > smallest ? raised : smallest;
}

/// The product of two numbers >= 0 that is zero only if `a` is: neither overflow nor underflow spoils a bound.
constexpr float positive_product(float a, float positive) {
    constexpr float smallest = (std::numeric_limits<float>::min)();
    const float product = a * positive;
    const float raised = product > smallest ? product : smallest;
    return a > 0.0f ? raised : 0.0f;
}

/// s * with_rounding_margin(factor), channel by channel; black channels stay black. pre: factor >= 0
template <Spectrum S>
S scaled_up(const S& s, double factor) {
    const float k = with_rounding_margin(factor);
    return make_spectrum<S>([&](int i) { return positive_product(channel(s, i), k); });
}

}  // namespace lightcuts::detail
