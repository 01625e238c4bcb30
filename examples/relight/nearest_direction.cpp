#include "nearest_direction.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <oneapi/tbb/parallel_for.h>
#include <glm/geometric.hpp>

namespace relight {

namespace {

/// At the equator; towards the poles there are more.
constexpr double cells_per_direction = 64.0;

/// Directions in a grid of cubes over the ball, a few in each of those that meet the sphere.
class Buckets {
public:
    explicit Buckets(std::span<const glm::vec3> directions) : directions_(directions) {
        side_ = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(directions.size()) / 8.0)), 1, 128);
        const auto cubes = static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_ * side_);
        begin_.assign(cubes + 1, 0);
        for (const glm::vec3& d : directions) ++begin_[cube_of(d) + 1];
        for (std::size_t c = 1; c < begin_.size(); ++c) begin_[c] += begin_[c - 1];
        std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
        order_.resize(directions.size());
        for (std::uint32_t i = 0; i < directions.size(); ++i) order_[next[cube_of(directions[i])]++] = i;
    }

    std::uint32_t nearest(const glm::dvec3& d) const {
        std::uint32_t best = 0;
        double least = 8.0;
        const int x = coordinate(d.x), y = coordinate(d.y), z = coordinate(d.z);
        const double edge = 2.0 / side_;
        // Shells of cubes about that of d: what is in the next one is at least `reach` cubes away.
        for (int reach = 0; reach <= 2 * side_; ++reach) {
            const double distance = (reach - 1) * edge;
            if (reach > 0 && distance > 0.0 && distance * distance > least) break;
            for (int k = z - reach; k <= z + reach; ++k) {
                for (int j = y - reach; j <= y + reach; ++j) {
                    const bool is_face = std::abs(k - z) == reach || std::abs(j - y) == reach;
                    const int step = is_face || reach == 0 ? 1 : 2 * reach;
                    for (int i = x - reach; i <= x + reach; i += step) visit(i, j, k, d, best, least);
                }
            }
        }
        return best;
    }

private:
    int coordinate(double c) const { return std::clamp(static_cast<int>((c + 1.0) * 0.5 * side_), 0, side_ - 1); }
    std::size_t cube(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(side_) +
               static_cast<std::size_t>(x);
    }
    std::size_t cube_of(const glm::dvec3& d) const { return cube(coordinate(d.x), coordinate(d.y), coordinate(d.z)); }
    void visit(int x, int y, int z, const glm::dvec3& d, std::uint32_t& best, double& least) const {
        if (x < 0 || y < 0 || z < 0 || x >= side_ || y >= side_ || z >= side_) return;
        const std::size_t c = cube(x, y, z);
        for (std::uint32_t k = begin_[c]; k < begin_[c + 1]; ++k) {
            const glm::dvec3 apart = d - glm::dvec3(directions_[order_[k]]);
            const double distance2 = glm::dot(apart, apart);
            if (distance2 < least || (distance2 == least && order_[k] < best)) {
                least = distance2;
                best = order_[k];
            }
        }
    }

    std::span<const glm::vec3> directions_;
    int side_ = 1;
    std::vector<std::uint32_t> begin_, order_;
};

}  // namespace

NearestDirection::NearestDirection(std::span<const glm::vec3> directions)
    : rows_(static_cast<std::uint32_t>(std::ceil(
          std::sqrt(0.25 * std::numbers::pi * cells_per_direction * static_cast<double>(directions.size()))))),
      table_(std::size_t{2} * rows_ * rows_) {
    const Buckets buckets(directions);
    const std::uint32_t columns = 2 * rows_;
    tbb::parallel_for(std::uint32_t{0}, rows_, [&](std::uint32_t row) {
        const double latitude = std::numbers::pi * (0.5 - (row + 0.5) / rows_);
        const double sine = std::sin(latitude), cosine = std::cos(latitude);
        for (std::uint32_t column = 0; column < columns; ++column) {
            const double longitude = std::numbers::pi * (2.0 * (column + 0.5) / columns - 1.0);
            table_[std::size_t{row} * columns + column] = buckets.nearest(
                {std::sin(longitude) * cosine, sine, std::cos(longitude) * cosine});
        }
    });
}

std::size_t NearestDirection::cell_of(const glm::dvec3& d) const {
    const std::uint32_t columns = 2 * rows_;
    const double down = (0.5 - std::asin(std::clamp(d.y, -1.0, 1.0)) / std::numbers::pi) * rows_;
    const double across = (0.5 + std::atan2(d.x, d.z) / (2.0 * std::numbers::pi)) * columns;
    const auto within = [](double c, std::uint32_t end) {
        return std::min(static_cast<std::uint32_t>(std::max(c, 0.0)), end - 1);
    };
    return std::size_t{within(down, rows_)} * columns + within(across, columns);
}

}  // namespace relight
