#include <lightcuts/piecewise/even_directions.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/core/vector.hpp>

namespace lightcuts::test {
namespace {

/// The distance of each point to its nearest neighbor, in units of a hexagonal lattice's, ascending.
std::vector<double> spacings(const std::vector<glm::vec3>& points) {
    const double unit = std::sqrt(4 * std::numbers::pi / static_cast<double>(points.size()) * 2 / std::sqrt(3.0));
    std::vector<double> result;
    for (const glm::vec3& p : points) {
        double nearest = 2;
        for (const glm::vec3& q : points) {
            if (&p != &q) nearest = std::min(nearest, static_cast<double>(glm::distance(p, q)));
        }
        result.push_back(nearest / unit);
    }
    std::sort(result.begin(), result.end());
    return result;
}

TEST(EvenDirections, KeepApart) {
    for (const std::size_t count : {20u, 300u, 3000u}) {
        const auto even = even_directions(count, count);
        ASSERT_EQ(even.size(), count);
        for (const glm::vec3& d : even) EXPECT_TRUE(is_unit(d));
        const auto apart = spacings(even), before = spacings(even_directions(count, count, 0));
        EXPECT_GT(apart[0], 0.6) << count;
        EXPECT_GT(apart[count / 2], 0.8) << count;
        EXPECT_LT(before[0], 0.8 * apart[0]) << count;
    }
}

// No part of the sphere is left out: the mean of a smooth function over them is nearly that over the sphere.
TEST(EvenDirections, AddUpSmoothFunctions) {
    const auto error = [](int steps) {
        double worst = 0;
        const auto points = even_directions(2000, 5, steps);
        for (int axis = 0; axis < 3; ++axis) {
            double sum = 0, squares = 0;
            for (const glm::vec3& d : points) {
                sum += static_cast<double>(d[axis]) / 2000;
                squares += static_cast<double>(d[axis]) * static_cast<double>(d[axis]) / 2000;
            }
            worst = std::max({worst, std::abs(sum), std::abs(squares - 1.0 / 3.0)});
        }
        return worst;
    };
    // A fifth of the standard error of as many independent ones.
    EXPECT_LT(error(20), 0.2 / std::sqrt(3.0 * 2000.0));
}

TEST(EvenDirections, AreTheSameOnEveryRun) {
    EXPECT_EQ(even_directions(500, 1), even_directions(500, 1));
    EXPECT_NE(even_directions(500, 1), even_directions(500, 2));
    EXPECT_TRUE(even_directions(0).empty());
    EXPECT_EQ(even_directions(1).size(), 1u);
}

}  // namespace
}  // namespace lightcuts::test
