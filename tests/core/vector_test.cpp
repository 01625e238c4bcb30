#include <lightcuts/core/vector.hpp>

#include <array>
#include <limits>

#include <gtest/gtest.h>

namespace foreign_vectors {

/// A foreign vector with public members.
struct Point {
    double x, y, z;
};

/// A foreign vector without them.
struct Triple {
    std::array<float, 3> value;
};

/// Two coordinates only.
struct Flat {
    float x, y;
};

}  // namespace foreign_vectors

template <>
struct lightcuts::vector_traits<foreign_vectors::Triple> {
    static float x(const foreign_vectors::Triple& v) { return v.value[0]; }
    static float y(const foreign_vectors::Triple& v) { return v.value[1]; }
    static float z(const foreign_vectors::Triple& v) { return v.value[2]; }
};

namespace {

using namespace lightcuts;
using namespace foreign_vectors;

static_assert(Vector3<glm::vec3> && Vector3<glm::dvec3> && Vector3<Point> && Vector3<Triple>);
static_assert(!Vector3<Flat> && !Vector3<float> && !Vector3<std::array<float, 3>>);

TEST(Vector, EveryModelIsRead) {
    const glm::vec3 expected(1.0f, -2.0f, 3.5f);
    EXPECT_EQ(to_vec3(expected), expected);
    EXPECT_EQ(to_vec3(glm::dvec3(1.0, -2.0, 3.5)), expected);
    EXPECT_EQ(to_vec3(Point{1.0, -2.0, 3.5}), expected);
    EXPECT_EQ(to_vec3(Triple{{1.0f, -2.0f, 3.5f}}), expected);
}

TEST(Vector, FiniteMeansEveryCoordinate) {
    EXPECT_TRUE(is_finite({1.0f, 2.0f, std::numeric_limits<float>::max()}));
    for (int i = 0; i < 3; ++i) {
        for (const float bad : {std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity(),
                                std::numeric_limits<float>::quiet_NaN()}) {
            glm::vec3 v(1.0f);
            v[i] = bad;
            EXPECT_FALSE(is_finite(v));
        }
    }
}

}  // namespace
