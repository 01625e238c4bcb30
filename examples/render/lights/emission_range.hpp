#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>

#include <lightcuts/source/emitter.hpp>

#include "scene.hpp"
#include "surfaces/texture_range.hpp"

namespace render {

/// Bounds of `emitted_radiance` on the fronts of pieces of triangles.
class EmissionRange {
public:
    using Corners = lightcuts::PieceCorners;

    /// For triangles of `materials`. `scene` must outlive this object. cost: O(texels of their textures).
    EmissionRange(const Scene& scene, std::span<const std::uint32_t> materials);

    lightcuts::RadianceRange<> over(std::uint32_t triangle, const Corners& corners) const;

    /// The corner at which the edge begins that passes the most texels of what the emission depends on; empty where
    /// there are none.
    std::optional<std::size_t> longest_edge(std::uint32_t triangle, const Corners& corners) const;

    /// True iff a texel of the emission's map, or the factor without one, is not black.
    bool is_lit(const Material& material) const;

private:
    TexelRange texels(const TextureUse& use, std::uint32_t triangle, const Corners& corners) const;
    TexelRange vertex_colors(std::uint32_t triangle, const Corners& corners) const;
    const TextureRange* range_of(const TextureUse& use) const;

    const Scene& scene_;
    std::map<int, TextureRange> ranges_;  ///< by texture
};

}  // namespace render
