#include "scenes/shapes.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace render {

glm::vec3 BlockGrid::middle(const glm::ivec3& cell) const {
    glm::vec3 m(0.0f);
    for (int k = 0; k < 3; ++k) {
        const auto& own = planes[static_cast<std::size_t>(k)];
        const auto at = static_cast<std::size_t>(cell[k]);
        m[k] = 0.5f * (own[at] + own[at + 1]);
    }
    return m;
}

void Modeller::blocks(const BlockGrid& grid, const std::function<bool(const glm::ivec3&)>& solid,
                      const std::function<std::uint32_t(const glm::ivec3&, int, int)>& paint_of) {
    const glm::ivec3 cells(grid.cells(0), grid.cells(1), grid.cells(2));
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> corners(static_cast<std::size_t>(cells.x + 1) * static_cast<std::size_t>(cells.y + 1) *
                                           static_cast<std::size_t>(cells.z + 1),
                                       none);
    const auto corner = [&](const glm::ivec3& at) {
        std::uint32_t& index = corners[static_cast<std::size_t>((at.z * (cells.y + 1) + at.y) * (cells.x + 1) + at.x)];
        if (index == none) {
            const glm::vec3 p(grid.planes[0][static_cast<std::size_t>(at.x)],
                              grid.planes[1][static_cast<std::size_t>(at.y)],
                              grid.planes[2][static_cast<std::size_t>(at.z)]);
            index = vertex(p, glm::vec3(0.0f));
        }
        return index;
    };
    const auto is_solid = [&](const glm::ivec3& cell) {
        for (int k = 0; k < 3; ++k) {
            if (cell[k] < 0 || cell[k] >= cells[k]) return false;
        }
        return solid(cell);
    };
    const auto add_face = [&](const glm::ivec3& cell, int axis, int side) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        std::array<std::uint32_t, 4> around{};
        for (int i = 0; i < 4; ++i) {
            glm::ivec3 at = cell;
            at[axis] += side > 0 ? 1 : 0;
            at[u] += i == 1 || i == 2 ? 1 : 0;
            at[v] += i >= 2 ? 1 : 0;
            around[static_cast<std::size_t>(i)] = corner(at);
        }
        if (side < 0) std::swap(around[1], around[3]);
        material = paint_of(cell, axis, side);
        triangle(around[0], around[1], around[2]);
        triangle(around[0], around[2], around[3]);
    };
    glm::ivec3 cell(0);
    for (cell.z = 0; cell.z < cells.z; ++cell.z) {
        for (cell.y = 0; cell.y < cells.y; ++cell.y) {
            for (cell.x = 0; cell.x < cells.x; ++cell.x) {
                if (!is_solid(cell)) continue;
                for (int axis = 0; axis < 3; ++axis) {
                    for (const int side : {-1, 1}) {
                        glm::ivec3 beside = cell;
                        beside[axis] += side;
                        if (!is_solid(beside)) add_face(cell, axis, side);
                    }
                }
            }
        }
    }
}

}  // namespace render
