#pragma once

#include <bit>
#include <cstdint>

#include <glm/vec3.hpp>

#include "rounding.hpp"

namespace lightcuts {

/// Arithmetic on several values side by side: plain loops over arrays of this many floats, which compilers turn into
/// vector code. The functions below keep such loops free of what would stop them.
inline constexpr int lane_count = 8;
using Lanes = float[lane_count];

/// A vector for each lane.
struct LaneVectors {
    alignas(32) Lanes x[3];

    /// pre: 0 <= lane < lane_count
    void set(int lane, const glm::vec3& v) {
        x[0][lane] = v.x;
        x[1][lane] = v.y;
        x[2][lane] = v.z;
    }
    glm::vec3 at(int lane) const { return {x[0][lane], x[1][lane], x[2][lane]}; }
};

namespace detail {

/// `condition ? a : b` by masks: a conditional would let compilers compute an arm only where it is needed, and then
/// refuse to vectorize the loop.
[[gnu::always_inline]] inline float select(bool condition, float a, float b) {
    const std::uint32_t mask = 0u - static_cast<std::uint32_t>(condition);
    return std::bit_cast<float>((std::bit_cast<std::uint32_t>(a) & mask) | (std::bit_cast<std::uint32_t>(b) & ~mask));
}

[[gnu::always_inline]] inline float magnitude(float x) {
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) & 0x7fffffffu);
}
[[gnu::always_inline]] inline float larger(float x, float y) { return select(x > y, x, y); }
[[gnu::always_inline]] inline float smaller(float x, float y) { return select(x < y, x, y); }

/// 1 / sqrt(x) within 2e-7, in arithmetic that vectorizes everywhere (sqrt itself sets errno); finite at 0.
[[gnu::always_inline]] inline float inverse_sqrt(float x) {
    float y = std::bit_cast<float>(0x5f375a86u - (std::bit_cast<std::uint32_t>(x) >> 1));
    const float half = 0.5f * x;
    y = y * (1.5f - half * y * y);
    y = y * (1.5f - half * y * y);
    y = y * (1.5f - half * y * y);
    return y;
}

/// Repeats the last of `count` values in the lanes behind it. pre: 0 < count <= lane_count
inline void repeat_last(Lanes& lanes, int count) {
    for (int i = count; i < lane_count; ++i) lanes[i] = lanes[count - 1];
}
inline void repeat_last(LaneVectors& vectors, int count) {
    for (Lanes& coordinate : vectors.x) repeat_last(coordinate, count);
}

/// sqrt(x) within 4e-7; 0 at 0.
[[gnu::always_inline]] inline float square_root(float x) { return x * inverse_sqrt(x); }

}  // namespace detail

}  // namespace lightcuts
