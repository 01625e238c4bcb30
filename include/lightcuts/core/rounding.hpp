#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "lightcuts: compile without -ffast-math and -ffinite-math-only; its guards rely on infinities and NaN"
#endif

namespace lightcuts {

/// Unit roundoff of double: half the distance from 1 to the next number.
inline constexpr double unit_roundoff = 0x1p-53;

/// The next number above `x`; NaN and +infinity stay. Bit arithmetic only, so it also works where denormals are
/// flushed, and in vectorized loops.
constexpr float next_up(float x) {
    const auto bits = std::bit_cast<std::uint32_t>(x);
    const std::uint32_t magnitude = bits & 0x7fffffffu;
    const std::uint32_t stepped = magnitude == 0u ? 1u : bits == magnitude ? bits + 1u : bits - 1u;
    const bool stays = magnitude > 0x7f800000u || bits == 0x7f800000u;
    return std::bit_cast<float>(stays ? bits : stepped);
}

/// The next number below `x`; NaN and -infinity stay.
constexpr float next_down(float x) { return -next_up(-x); }

/// The next number above `x`; NaN and +infinity stay.
constexpr double next_up(double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    const std::uint64_t magnitude = bits & 0x7fffffffffffffffu;
    const std::uint64_t stepped = magnitude == 0u ? 1u : bits == magnitude ? bits + 1u : bits - 1u;
    const bool stays = magnitude > 0x7ff0000000000000u || bits == 0x7ff0000000000000u;
    return std::bit_cast<double>(stays ? bits : stepped);
}

/// The next number below `x`; NaN and -infinity stay.
constexpr double next_down(double x) { return -next_up(-x); }

/// The smallest float not below `x`, except that a positive result is at least the smallest *normal* float: a bound
/// that is not zero stays so where denormals are flushed. Infinite above the largest float; NaN stays.
constexpr float round_up(double x) {
    const float nearest = static_cast<float>(x);
    const float above = static_cast<double>(nearest) < x ? next_up(nearest) : nearest;
    constexpr float smallest = (std::numeric_limits<float>::min)();
    return x > 0.0 && above < smallest ? smallest : above;
}

namespace detail {
constexpr double larger(double x, double y) { return x < y ? y : x; }
constexpr double smaller(double x, double y) { return x < y ? x : y; }
}  // namespace detail

/// The largest float not above `x`, except that a negative result is at most minus the smallest normal float.
constexpr float round_down(double x) { return -round_up(-x); }

}  // namespace lightcuts
