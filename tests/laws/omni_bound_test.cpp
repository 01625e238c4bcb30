#include "laws/cluster_bound_law.hpp"

namespace lightcuts::test {
namespace {

TEST(OmniBound, IsNeverBelowAnyLight) { expect_bounds_hold_over_all_materials<OmniLight<>>(1); }

TEST(OmniBound, IsNeverBelowAnyLightWithItsOwnFalloff) {
    expect_bounds_hold_over_all_materials<OmniLight<glm::vec3, PolynomialFalloff>>(2);
}

TEST(DirectionalBound, IsNeverBelowAnyLight) { expect_bounds_hold_over_all_materials<DistantLight<>>(3); }

}  // namespace
}  // namespace lightcuts::test
