#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "scene.hpp"

namespace render {

/// A material's parameters at one point: textures and vertex colors applied.
struct SurfaceColors {
    glm::vec3 base{0.0f};
    float opacity = 1;  ///< share of the point that is there at all: alpha MASK gives 0 or 1, BLEND alpha
    float metallic = 0;
    float roughness = 1;
    glm::vec3 specular{0.0f};        ///< phong: Ks; else reflectance at normal incidence
    float grazing = 1;               ///< reflectance at grazing incidence, at least `specular`; phong has none
    float transmission = 0;          ///< share of light that passes, to be tinted by `base`; 0 where metallic
    float diffuse_transmission = 0;  ///< of the rest's diffuse part: share that leaves on the other side
    glm::vec3 diffuse_transmission_color{0.0f};  ///< black where that is 0
};

/// What `use` reads at barycentric (u, v) of `triangle`: (1, 1, 1, 1) without a texture, the texel of uv (0, 0) without
/// texture coordinates.
glm::vec4 texel_at(const Scene& scene, const TextureUse& use, std::uint32_t triangle, float u, float v);

/// All of a material's parameters at barycentric (u, v) of `triangle`.
SurfaceColors colors_at(const Scene& scene, std::uint32_t triangle, float u, float v);

/// Radiance that barycentric (u, v) of `triangle` emits towards those who see its `front`, from where its corners run
/// counter-clockwise, or its back: what is seen of it, what lights by it, and what it shows in mirrors. Emission times
/// its texture (and, of unlit materials, the vertex color) times opacity; 0 on a side that does not emit.
glm::vec3 emitted_radiance(const Scene& scene, std::uint32_t triangle, float u, float v, bool front);

/// True iff `emitted_radiance` varies over triangles of `material`.
bool has_varying_emission(const Scene& scene, const Material& material);

/// The share of a surface of `material` that is there where its alpha is `alpha`; it does not fall as that grows.
float opacity_of_alpha(const Material& material, float alpha);

/// `colors_at(...).opacity` alone.
float opacity_at(const Scene& scene, std::uint32_t triangle, float u, float v);

/// What a shadow ray keeps of light that crosses the point, per channel: 1 - opacity + opacity x transmission x base.
glm::vec3 tint_at(const Scene& scene, std::uint32_t triangle, float u, float v);

/// Which materials let some light pass somewhere. An alpha mode that no texel makes use of does not count.
std::vector<bool> transmissive_materials(const Scene& scene);

}  // namespace render
