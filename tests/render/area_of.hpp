#pragma once

#include <cstdint>
#include <span>

#include <render/scene.hpp>
#include <render/triangle.hpp>

/// The area of `triangles` together.
inline double area_of(const render::Scene& scene, std::span<const std::uint32_t> triangles) {
    double area = 0;
    for (const std::uint32_t t : triangles) area += render::Triangle(scene, t).area();
    return area;
}
