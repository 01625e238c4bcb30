#pragma once

#include <cstdint>
#include <span>

#include <glm/vec2.hpp>

#include "scenes/shapes.hpp"

namespace render {

/// Things of stone, metal and glaze for the built-in scenes. Each stands on the origin of the modeller's `place`;
/// lengths are in meters, materials are indices.

/// A lying ring: `radius` from its middle to the middle of its pipe.
void add_torus(Modeller& m, float radius, float pipe, int length_segments, int segments, std::uint32_t material);

/// A body of revolution with a flat base: `outline` is (radius, height) from the base to the axis, made smooth.
void add_turned(Modeller& m, std::span<const glm::vec2> outline, float size, int segments, std::uint32_t material);

/// A wine cup, hollow.
void add_goblet(Modeller& m, float height, int segments, std::uint32_t metal);

/// A chessman.
void add_pawn(Modeller& m, float height, int segments, std::uint32_t material);

/// A Doric column: a fluted shaft that swells and tapers, and a capital. `radius`: of its foot.
void add_fluted_column(Modeller& m, float radius, float height, int flutes, std::uint32_t stone);

/// Part of a frieze against the wall z = 0: three upright bars from `low` up over `height`, and drops below them.
void add_triglyph(Modeller& m, float low, float height, std::uint32_t stone);

/// A cypress: a ragged spindle.
void add_cypress(Modeller& m, float height, Dice& dice, std::uint32_t leaf);

/// A standing figure in a long robe, on a plinth of a quarter of its height.
void add_statue(Modeller& m, float height, std::uint32_t plinth, std::uint32_t body);

}  // namespace render
