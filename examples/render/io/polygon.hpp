#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace render {

/// Cuts a polygon into triangles, whose corners are places in `outline`; they keep its sense of rotation. Convex ones
/// become fans. Others are cut ear by ear in the plane that fits them best, also those whose outline runs to a hole
/// and back. Of an outline that crosses itself, parts may be covered twice or not at all.
/// pre: outline.size() >= 3. cost: O(n) for convex outlines, else O(n k) for k corners that bend inwards.
std::vector<std::array<std::uint32_t, 3>> triangles_of(std::span<const glm::dvec3> outline);

}  // namespace render
