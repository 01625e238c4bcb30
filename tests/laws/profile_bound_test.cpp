#include "laws/cluster_bound_law.hpp"

namespace lightcuts::test {
namespace {

TEST(SpotBound, IsNeverBelowAnyLight) { expect_bounds_hold_over_all_materials<SpotLight<>>(7); }

TEST(ScatteringBound, IsNeverBelowAnyLight) { expect_bounds_hold_over_all_materials<ScatteringPointLight<>>(9); }

TEST(ProfileBound, IsNeverBelowAnyLight) { expect_bounds_hold_over_all_materials<RingLight>(8); }

}  // namespace
}  // namespace lightcuts::test
