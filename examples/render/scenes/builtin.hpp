#pragma once

#include <cstddef>

#include "scene.hpp"

namespace render {

/// A hall of 20 x 6 x 12 m with columns, beams, a partition, books, vases and plants, about 50,000 triangles. Its
/// lights are 72 square ceiling panels of 0.6 m, emissive surfaces of two triangles each.
Scene builtin_hall();

/// A garden at night: `lights` fireflies, omni lights in the air between trees, rocks and lanterns.
Scene builtin_omni(std::size_t lights);

/// A field of clutter under a sky of `lights` directional lights, brighter around the sun.
Scene builtin_directional(std::size_t lights);

/// A furnished room with `lights` oriented lights spread over all its surfaces, as light reflected once would be.
/// `rotated`: turned about an oblique axis, so that nothing in it is along the coordinate axes.
Scene builtin_surfaces(std::size_t lights, bool rotated);

/// A still life of glossy and matt things on a tray, about 160,000 triangles, in a studio at dusk: a map of windows,
/// screens of light and one small lamp.
Scene builtin_tableau();

/// A roulette wheel under the same map, about 20,000 triangles: 37 glossy bins between mirrors. It turns 0.8 times a
/// second, and its ball the other way: to be seen with a shutter that is open for a while.
Scene builtin_wheel();

/// A temple of fluted columns around a cella, with statues and amphorae, about 220,000 triangles, in the sun, which is
/// most of what lights it: the rest is the sky's, and what the stone reflects.
Scene builtin_colonnade();

/// Glossy things on a table that recede from the camera, about 210,000 triangles, under the tableau's map and before a
/// curtain of bulbs, 156 spherical lights: to be seen through a wide lens.
Scene builtin_focus();

/// A hall of columns, tables and bookcases with tall windows on one side, about 80,000 triangles, into which the sun
/// shines: to be seen in fog, where the light stands in shafts.
Scene builtin_haze();

/// The colonnade's temple at night, about 220,000 triangles: under a dim moon, `lights` small lamps, spherical lights,
/// fly about it in circles while the shutter is open. To be seen in fog.
Scene builtin_night(std::size_t lights);

/// Nine trees on a meadow, about 640,000 triangles: single leaves and blades of grass, of eleven materials that let
/// light through, under sun and sky.
Scene builtin_foliage();

/// An office at night, about 40,000 triangles, with two monitors of 640 x 480 pixels that show pictures. Every pixel is
/// an oriented light; two dim panels at the ceiling are emissive surfaces.
Scene builtin_screens();

/// A classroom of 9 x 3.2 x 7.2 m with windows in two walls, desks, chairs, shelves and plants, into which the sun
/// shines: sun, sky and 20,000 virtual lights. Floor, walls, ceiling and window bars are one mesh that shares corners.
Scene builtin_classroom();

/// An office floor of 94 x 64 m: 200 furnished rooms along five corridors, which a sixth one joins; half of the doors
/// are open. `lights` oriented lights on hanging panels and desk lamps, nearly all of which are
/// hidden from any point.
Scene builtin_office(std::size_t lights);

/// A glTF file, written and read in memory, with 5 rows of 6 tiles, one for each feature of the format: see
/// docs/renderer.md. The left half of a tile uses the feature, the right half has as a plain color what a correct
/// reader makes of it. Below, pools of light of a point, a spot and a sphere.
Scene builtin_test_card();

/// Tiles are 1 x 1, their lower left corners `pitch` apart; the first one's is the origin, rows go downwards. The
/// camera `card` is orthographic, as high as `height` about `middle`.
inline constexpr int test_card_columns = 6;
inline constexpr int test_card_rows = 5;
inline constexpr float test_card_pitch = 1.1f;
inline constexpr float test_card_middle = -2.4f;
inline constexpr float test_card_height = 7.2f;

}  // namespace render
