#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace relight {

/// Which of the directions spread over the sphere is the nearest: a table over longitude and latitude, of several
/// cells a direction.
class NearestDirection {
public:
    /// pre: at least one direction. threads: those of the calling arena. cost: some neighbors a cell.
    explicit NearestDirection(std::span<const glm::vec3> directions);

    /// The item nearest to the middle of the cell that the unit vector `direction` is in.
    std::uint32_t operator()(const glm::dvec3& direction) const { return table_[cell_of(direction)]; }

private:
    std::size_t cell_of(const glm::dvec3& direction) const;

    std::uint32_t rows_;
    std::vector<std::uint32_t> table_;  ///< rows of twice as many cells
};

}  // namespace relight
