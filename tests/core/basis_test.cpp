#include <lightcuts/core/basis.hpp>

#include <cmath>

#include <gtest/gtest.h>

#include "support/random.hpp"

namespace lightcuts::test {
namespace {

void expect_near(const glm::dvec3& a, const glm::dvec3& b) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 1e-14);
}

TEST(Basis, IsOrthonormalAndRightHandedAboutAnyAxis) {
    Random random(1);
    for (int trial = 0; trial < 1000; ++trial) {
        glm::dvec3 axis = random.on_sphere();
        if (trial == 0) axis = {0.0, 0.0, 1.0};
        if (trial == 1) axis = {0.0, 0.0, -1.0};
        if (trial == 2) axis = glm::normalize(glm::dvec3(1e-9, 1e-9, -1.0));
        const Basis basis(axis);
        expect_near(basis.z, axis);
        expect_near(glm::cross(basis.x, basis.y), axis);
        EXPECT_NEAR(glm::dot(basis.x, basis.y), 0.0, 1e-14);
        EXPECT_NEAR(glm::length(basis.x), 1.0, 1e-14);
        const glm::dvec3 v = random.on_sphere();
        expect_near(basis.in(basis.out(v)), v);
        EXPECT_NEAR(glm::dot(basis.out(v), axis), v.z, 1e-14);
    }
}

TEST(AroundZ, HasTheCosineAndTheTurn) {
    for (const double cosine : {-1.0, -0.3, 0.0, 0.8, 1.0}) {
        const glm::dvec3 quarter = around_z(cosine, 0.25);
        EXPECT_NEAR(glm::length(quarter), 1.0, 1e-14);
        EXPECT_EQ(quarter.z, cosine);
        EXPECT_NEAR(quarter.x, 0.0, 1e-14);
        EXPECT_NEAR(quarter.y, std::sqrt(1.0 - cosine * cosine), 1e-14);
    }
}

}  // namespace
}  // namespace lightcuts::test
