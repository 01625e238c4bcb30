#pragma once

#include "scenes/shapes.hpp"

namespace render {

/// A temple of fluted columns around a cella, with statues and amphorae, about 220,000 triangles. It stands along z,
/// its floor at y = 0 and the ground around it at `ground`; columns stand on a rectangle of 6 by 10.
struct Temple {
    static constexpr float half_width = 6.0f;    ///< to the columns' axes
    static constexpr float half_length = 11.7f;  ///< likewise
    static constexpr int columns_across = 6;
    static constexpr int columns_along = 10;
    static constexpr float column_radius = 0.52f;
    static constexpr float column_height = 5.2f;
    static constexpr float ceiling = column_height + 0.75f;  ///< over the aisles
    static constexpr float step_height = 0.32f;
    static constexpr float ground = -3.0f * step_height;
    static constexpr float cella_x = 2.9f;  ///< to the outer sides of the cella's walls
    static constexpr float cella_z = 8.2f;
};

void add_temple(Modeller& m);

}  // namespace render
