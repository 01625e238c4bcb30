#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "scene.hpp"

namespace render {

/// A material's parameters at one point, textures applied.
struct SurfaceColors {
    glm::vec3 base{0.0f};
    float cover = 1;  ///< share of the point that is there at all: alpha MASK gives 0 or 1, BLEND alpha
    float metallic = 0;
    float roughness = 1;
    float transmission = 0;          ///< share of light that passes, to be tinted by `base`; 0 where metallic
    float diffuse_transmission = 0;  ///< of the rest's diffuse part: share that leaves on the other side
    glm::vec3 diffuse_transmission_color{0.0f};  ///< black where that is 0
    glm::vec3 emission{0.0f};
};

/// Texture coordinates at barycentric (u, v) of `triangle`; (0, 0) in a scene without.
glm::vec2 uv_at(const Scene& scene, std::uint32_t triangle, float u, float v);

/// All of a material's parameters at barycentric (u, v) of `triangle`.
SurfaceColors colors_at(const Scene& scene, std::uint32_t triangle, float u, float v);

/// `colors_at(...).emission` alone.
glm::vec3 emission_at(const Scene& scene, std::uint32_t triangle, float u, float v);

/// `colors_at(...).cover` alone.
float cover_at(const Scene& scene, std::uint32_t triangle, float u, float v);

/// What a shadow ray keeps of light that crosses the point, per channel: 1 - cover + cover x transmission x base.
glm::vec3 tint_at(const Scene& scene, std::uint32_t triangle, float u, float v);

/// Which materials let some light pass somewhere. An alpha mode that no texel makes use of does not count.
std::vector<bool> transmissive_materials(const Scene& scene);

}  // namespace render
