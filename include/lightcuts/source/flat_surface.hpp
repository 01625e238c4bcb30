#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "planar_rectangle.hpp"
#include "sampler.hpp"
#include "triangle_pieces.hpp"

namespace lightcuts::detail {

/// Triangles in one plane that face one way, laid out in the smallest rectangle around them, with a grid to find them
/// by their points.
class FlatSurface {
public:
    struct Place {
        glm::dvec3 position;
        std::size_t facet;  ///< that it lies in
    };

    /// Empty if the triangles do not lie in one plane, or face both ways. pre: none is without area
    static std::optional<FlatSurface> of(std::span<const Facet> facets) {
        if (facets.empty()) return std::nullopt;
        const std::optional<glm::dvec3> normal = common_normal(facets);
        if (!normal) return std::nullopt;
        return FlatSurface(facets, *normal);
    }

    const glm::dvec3& normal() const { return normal_; }

    /// The first `count` of the points (`sampler(i, 2)`, `sampler(i, 3)`) of the rectangle that lie on the surface:
    /// they depend on its outline alone. Empty if it fills its rectangle too sparsely.
    template <Sampler Sequence>
    std::vector<Place> points(std::size_t count, const Sequence& sampler) const {
        constexpr std::size_t most_tries = 64;  // for each point
        std::vector<Place> places;
        places.reserve(count);
        for (std::size_t i = 0; places.size() < count; ++i) {
            if (i >= most_tries * count) return {};
            const auto index = static_cast<std::uint32_t>(i);
            const glm::dvec2 p(static_cast<double>(sampler(index, 2)) * rectangle_.width,
                               static_cast<double>(sampler(index, 3)) * rectangle_.height);
            if (const auto facet = facet_at(p)) places.push_back({rectangle_.at(p), *facet});
        }
        return places;
    }

private:
    using Corners = std::array<glm::dvec2, 3>;

    FlatSurface(std::span<const Facet> facets, const glm::dvec3& normal)
        : normal_(normal), rectangle_(smallest_rectangle(facets, normal)) {
        corners_.reserve(facets.size());
        for (const Facet& f : facets) {
            corners_.push_back({rectangle_.local(f.a), rectangle_.local(f.b), rectangle_.local(f.c)});
        }
        make_grid();
    }

    /// About as many cells as triangles; fewer where long and thin ones would lie in too many.
    void make_grid() {
        constexpr std::size_t most_entries = 16;  // of a triangle, on average
        cells_ = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(corners_.size()))));
        while (cells_ > 1 && entry_count() > most_entries * corners_.size()) cells_ /= 2;
        starts_.assign(cells_ * cells_ + 1, 0);
        for (const Corners& c : corners_) for_cells(c, [&](std::size_t cell) { ++starts_[cell + 1]; });
        for (std::size_t cell = 0; cell < cells_ * cells_; ++cell) starts_[cell + 1] += starts_[cell];
        members_.resize(starts_.back());
        std::vector<std::size_t> next = starts_;
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            for_cells(corners_[i], [&](std::size_t cell) { members_[next[cell]++] = static_cast<std::uint32_t>(i); });
        }
    }

    struct Cells {
        std::size_t first_x, last_x, first_y, last_y;
    };
    std::size_t cell_along(double x, double length) const {
        const auto cells = static_cast<double>(cells_);
        return static_cast<std::size_t>(std::clamp(std::floor(x / length * cells), 0.0, cells - 1.0));
    }
    Cells cells_of(const Corners& corners) const {
        const auto& [a, b, c] = corners;
        const double width = rectangle_.width, height = rectangle_.height;
        // A point on the edge of a triangle and of a cell must not slip through.
        const glm::dvec2 slack(1e-9 * width, 1e-9 * height);
        const glm::dvec2 low = (glm::min)(a, (glm::min)(b, c)) - slack;
        const glm::dvec2 high = (glm::max)(a, (glm::max)(b, c)) + slack;
        return {cell_along(low.x, width), cell_along(high.x, width), cell_along(low.y, height),
                cell_along(high.y, height)};
    }
    std::size_t entry_count() const {
        std::size_t entries = 0;
        for (const Corners& corners : corners_) {
            const Cells in = cells_of(corners);
            entries += (in.last_x - in.first_x + 1) * (in.last_y - in.first_y + 1);
        }
        return entries;
    }
    template <class F>
    void for_cells(const Corners& corners, F&& f) const {
        const Cells in = cells_of(corners);
        for (std::size_t y = in.first_y; y <= in.last_y; ++y) {
            for (std::size_t x = in.first_x; x <= in.last_x; ++x) f(y * cells_ + x);
        }
    }

    std::optional<std::size_t> facet_at(const glm::dvec2& p) const {
        const double slack = -1e-12 * rectangle_.width * rectangle_.width;
        const std::size_t cell = cell_along(p.y, rectangle_.height) * cells_ + cell_along(p.x, rectangle_.width);
        for (std::size_t m = starts_[cell]; m < starts_[cell + 1]; ++m) {
            const auto& [a, b, c] = corners_[members_[m]];
            if (cross(b - a, p - a) >= slack && cross(c - b, p - b) >= slack && cross(a - c, p - c) >= slack) {
                return members_[m];
            }
        }
        return std::nullopt;
    }

    glm::dvec3 normal_;
    PlanarRectangle rectangle_;
    std::vector<Corners> corners_;  ///< in the rectangle
    std::size_t cells_ = 1;         ///< of the grid, along each side
    std::vector<std::size_t> starts_;
    std::vector<std::uint32_t> members_;  ///< of cell i, from starts_[i] to starts_[i + 1]
};

}  // namespace lightcuts::detail
