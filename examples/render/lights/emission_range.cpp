#include "lights/emission_range.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "surfaces/surface_colors.hpp"

namespace render {
namespace {

using glm::dvec2;

/// Where `use` looks at the corners of a piece.
std::array<dvec2, 3> uvs_of(const Scene& scene, const TextureUse& use, std::uint32_t triangle,
                            const EmissionRange::Corners& corners) {
    const auto transformed = [&](const dvec2& uv) {
        return dvec2(use.uv.offset) + uv.x * dvec2(use.uv.u_axis) + uv.y * dvec2(use.uv.v_axis);
    };
    if (use.uv_set >= scene.uv_sets.size() || scene.uv_sets[use.uv_set].empty()) {
        const dvec2 origin = transformed(dvec2(0.0));
        return {origin, origin, origin};
    }
    const std::vector<glm::vec2>& uvs = scene.uv_sets[use.uv_set];
    const glm::uvec3 t = scene.triangles[triangle];
    const dvec2 a(uvs[t.x]);
    const dvec2 b(uvs[t.y]);
    const dvec2 c(uvs[t.z]);
    std::array<dvec2, 3> result;
    for (std::size_t i = 0; i < 3; ++i) {
        const dvec2 at(corners[i]);
        result[i] = transformed((1.0 - at.x - at.y) * a + at.x * b + at.y * c);
    }
    return result;
}

/// All that the emission of `material` may depend on.
std::array<const TextureUse*, 3> uses_of(const Material& material) {
    static const TextureUse none;
    const bool has_opacity = material.alpha != Material::Alpha::opaque;
    return {&material.emission_texture, has_opacity ? &material.base_color_texture : &none,
            has_opacity ? &material.alpha_texture : &none};
}

/// A number times one in a range, both of them not negative.
TexelRange product(const TexelRange& a, const TexelRange& b) { return {a.low * b.low, a.high * b.high}; }

}  // namespace

EmissionRange::EmissionRange(const Scene& scene, std::span<const std::uint32_t> materials) : scene_(scene) {
    for (const std::uint32_t m : materials) {
        for (const TextureUse* use : uses_of(scene.materials[m])) {
            if (use->is_there()) {
                ranges_.try_emplace(use->texture, scene.textures[static_cast<std::size_t>(use->texture)]);
            }
        }
    }
}

const TextureRange* EmissionRange::range_of(const TextureUse& use) const {
    return use.is_there() ? &ranges_.at(use.texture) : nullptr;
}

TexelRange EmissionRange::texels(const TextureUse& use, std::uint32_t triangle, const Corners& corners) const {
    const TextureRange* range = range_of(use);
    if (!range) return {};
    const auto [a, b, c] = uvs_of(scene_, use, triangle, corners);
    return range->over(glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c)));
}

TexelRange EmissionRange::vertex_colors(std::uint32_t triangle, const Corners& corners) const {
    if (scene_.colors.empty()) return {};
    const glm::uvec3 t = scene_.triangles[triangle];
    TexelRange range{glm::vec4(1.0f), glm::vec4(0.0f)};
    for (const glm::vec2& at : corners) {
        const glm::vec4 color = (1.0f - at.x - at.y) * scene_.colors[t.x] + at.x * scene_.colors[t.y] +
                                at.y * scene_.colors[t.z];
        range.low = glm::clamp(glm::min(range.low, color), 0.0f, 1.0f);
        range.high = glm::clamp(glm::max(range.high, color), 0.0f, 1.0f);
    }
    return range;
}

lightcuts::RadianceRange<> EmissionRange::over(std::uint32_t triangle, const Corners& corners) const {
    const Material& m = scene_.materials[scene_.triangle_material[triangle]];
    TexelRange range = texels(m.emission_texture, triangle, corners);
    const TexelRange colors = vertex_colors(triangle, corners);
    if (m.model == Material::Model::unlit) range = product(range, colors);
    lightcuts::RadianceRange<> bounds{m.emission * glm::vec3(range.low), m.emission * glm::vec3(range.high)};
    if (m.alpha == Material::Alpha::opaque) return bounds;
    const TextureUse& use = m.alpha_texture.is_there() ? m.alpha_texture : m.base_color_texture;
    const TexelRange alpha = product(texels(use, triangle, corners), colors);
    bounds.low *= opacity_of_alpha(m, m.base_alpha * alpha.low.a);
    bounds.high *= opacity_of_alpha(m, m.base_alpha * alpha.high.a);
    return bounds;
}

std::optional<std::size_t> EmissionRange::longest_edge(std::uint32_t triangle, const Corners& corners) const {
    const Material& m = scene_.materials[scene_.triangle_material[triangle]];
    std::array<double, 3> texels{};
    for (const TextureUse* use : uses_of(m)) {
        const TextureRange* range = range_of(*use);
        if (!range) continue;
        const std::array<dvec2, 3> uvs = uvs_of(scene_, *use, triangle, corners);
        for (std::size_t i = 0; i < 3; ++i) {
            texels[i] = std::max(texels[i], glm::length((uvs[(i + 1) % 3] - uvs[i]) * range->size()));
        }
    }
    const auto most = std::max_element(texels.begin(), texels.end());
    if (*most > 0.0 && std::isfinite(*most)) return static_cast<std::size_t>(most - texels.begin());
    return std::nullopt;
}

bool EmissionRange::is_lit(const Material& material) const {
    const TextureRange* range = range_of(material.emission_texture);
    const glm::vec3 most = material.emission * (range ? glm::vec3(range->over_all().high) : glm::vec3(1.0f));
    return most != glm::vec3(0.0f);
}

}  // namespace render
