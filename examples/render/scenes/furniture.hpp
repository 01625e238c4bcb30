#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "scenes/shapes.hpp"

namespace render {

/// Furniture for the built-in scenes, in meters. Each piece stands on the origin of the modeller's `place` and is
/// about as large as such a piece is; materials are indices.
void add_table(Modeller& m, float length, float width, std::uint32_t top, std::uint32_t legs);
void add_chair(Modeller& m, std::uint32_t wood, std::uint32_t seat);

/// `style` 0, 1 or 2: amphora, bottle, jar.
void add_vase(Modeller& m, int style, float height, int segments, std::uint32_t glaze);

void add_column(Modeller& m, float radius, float height, int segments, std::uint32_t stone);

/// A pot with `leaves` bent leaves.
void add_plant(Modeller& m, float size, int leaves, Dice& dice, std::uint32_t pot, std::uint32_t leaf);

/// A lying stack of `count` books.
void add_book_stack(Modeller& m, int count, Dice& dice, std::span<const std::uint32_t> covers);

/// Open towards +z, its back at z = 0; `shelves` boards full of books.
void add_bookcase(Modeller& m, float width, float height, int shelves, Dice& dice, std::uint32_t wood,
                  std::span<const std::uint32_t> covers);

/// A (2, 3) torus knot of outer radius `size`, its lowest point at y = 0.
void add_knot(Modeller& m, float size, int length_segments, int segments, std::uint32_t metal);

}  // namespace render
