#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>

#include <glm/vec3.hpp>

#include "lights/pieces.hpp"
#include "scene.hpp"
#include "surfaces/texture_range.hpp"

namespace render {

/// Bounds of `emitted_radiance` on the fronts of pieces of triangles.
class EmissionRange {
public:
    struct Bounds {
        glm::dvec3 low{0.0};
        glm::dvec3 high{0.0};
    };

    /// For triangles of `materials`. `scene` must outlive this object. cost: O(texels of their textures).
    EmissionRange(const Scene& scene, std::span<const std::uint32_t> materials);

    Bounds over(const Piece& piece) const;

    /// The corner at which the edge begins that passes the most texels of what the emission depends on; the longest in
    /// space where there are none.
    std::size_t longest_edge(const Piece& piece) const;

    /// True iff a texel of the emission's map, or the factor without one, is not black.
    bool is_lit(const Material& material) const;

private:
    TexelRange texels(const TextureUse& use, const Piece& piece) const;
    TexelRange vertex_colors(const Piece& piece) const;
    const TextureRange* range_of(const TextureUse& use) const;

    const Scene& scene_;
    std::map<int, TextureRange> ranges_;  ///< by texture
};

}  // namespace render
