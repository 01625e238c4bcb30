#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <glm/vec3.hpp>

#include "scenes/shapes.hpp"

namespace render {

/// What a broad-leaved tree looks like; lengths are in meters.
struct Broadleaf {
    float height = 7.0f;
    float reach = 0.42f;  ///< of its longest branches, as a share of the height
    float bare = 0.25f;   ///< share of the height without branches
    float leaf = 0.11f;   ///< a leaf's length
    int boughs = 16;      ///< that grow on the trunk; each has 6 branches of 6 twigs
    int leaves_a_twig = 28;
};

/// A tree on the origin of the modeller's `place`. Its leaves are single sheets of three triangles, each of one of the
/// materials `leaves`.
void add_broadleaf(Modeller& m, const Broadleaf& tree, Dice& dice, std::uint32_t bark,
                   std::span<const std::uint32_t> leaves);

/// A sheet of about `color` that reflects two fifths of its light from behind, through it, yellower.
std::uint32_t paint_leaf(Modeller& m, std::string name, const glm::vec3& color, float roughness);

}  // namespace render
