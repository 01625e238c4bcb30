#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include <glm/vec3.hpp>

namespace daylighting {

/// Which axis of a scene points upwards: glTF's y, with north along -z; or Radiance's z, with north along y. East is
/// along x in both.
enum class UpAxis : std::uint32_t { y, z };

/// `v` of a scene as x to the east, y to the north, z upwards.
template <class V>
constexpr V to_compass(const V& v, UpAxis up) {
    return up == UpAxis::y ? V(v.x, 0 - v.z, v.y) : v;
}
template <class V>
constexpr V from_compass(const V& v, UpAxis up) {
    return up == UpAxis::y ? V(v.x, v.z, 0 - v.y) : v;
}

/// A point that measures the light that falls on a plane.
struct Sensor {
    glm::dvec3 position{0.0};            ///< in the scene's world coordinates
    glm::vec3 normal{0.0f, 1.0f, 0.0f};  ///< unit

    bool operator==(const Sensor&) const = default;
};

/// Sensors in their order; those of a grid row by row.
struct SensorSet {
    std::vector<Sensor> sensors;
    std::uint32_t columns = 0;  ///< of a grid from west to east; 0 if they are none
    std::uint32_t rows = 0;     ///< from north to south
    UpAxis up = UpAxis::y;
};

/// A level rectangle, of which two opposite corners are given.
struct LevelGrid {
    glm::dvec3 corner{0.0};
    glm::dvec3 opposite{0.0};
    double spacing = 0.5;
};

/// A sensor in the middle of each cell of a grid, looking up; cells are about `spacing` wide and fill the rectangle.
/// throws: invalid_input if the corners are not level, or not apart; or if there are too many cells.
SensorSet sensors_of(const LevelGrid& grid, UpAxis up);

/// Reads sensors as Radiance's programs do: a position and a direction, `x y z dx dy dz`, a line; lines that are empty
/// or begin with `#` are passed over.
/// throws: invalid_input, one line naming the file and the line: other than six finite numbers, a direction of no
/// length, too many sensors or none.
SensorSet read_sensors(const std::filesystem::path& path, UpAxis up);

}  // namespace daylighting
