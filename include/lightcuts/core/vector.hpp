#pragma once

#include <concepts>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace lightcuts {

/// How the library reads a three-dimensional vector that it does not own.
///
/// The primary template serves every type with readable members `x`, `y`, `z` (GLM's among them).
/// Specialize it for any other type:
/// ```
/// template <> struct lightcuts::vector_traits<MyVector> {
///     static float x(const MyVector& v) { return v[0]; }  // likewise y, z
/// };
/// ```
template <class V>
struct vector_traits {};

template <class V>
    requires requires(const V& v) {
        { v.x } -> std::convertible_to<float>;
        { v.y } -> std::convertible_to<float>;
        { v.z } -> std::convertible_to<float>;
    }
struct vector_traits<V> {
    static constexpr float x(const V& v) { return static_cast<float>(v.x); }
    static constexpr float y(const V& v) { return static_cast<float>(v.y); }
    static constexpr float z(const V& v) { return static_cast<float>(v.z); }
};

/// A type that the library can read as three coordinates.
template <class V>
concept Vector3 = requires(const V& v) {
    { vector_traits<V>::x(v) } -> std::convertible_to<float>;
    { vector_traits<V>::y(v) } -> std::convertible_to<float>;
    { vector_traits<V>::z(v) } -> std::convertible_to<float>;
};

/// `v` as the library's own vector.
template <Vector3 V>
constexpr glm::vec3 to_vec3(const V& v) {
    if constexpr (std::same_as<V, glm::vec3>) {
        return v;
    } else {
        return {vector_traits<V>::x(v), vector_traits<V>::y(v), vector_traits<V>::z(v)};
    }
}

/// True iff every coordinate of `v` is finite.
inline bool is_finite(const glm::vec3& v) {
    const auto finite = [](float c) { return c - c == 0.0f; };
    return finite(v.x) && finite(v.y) && finite(v.z);
}

/// True iff the squared length of `v` is 1 within 1e-4; false if a coordinate is NaN.
inline bool is_unit(const glm::vec3& v) {
    const float excess = v.x * v.x + v.y * v.y + v.z * v.z - 1.0f;
    return excess > -1e-4f && excess < 1e-4f;
}

}  // namespace lightcuts
