#include "laws/cluster_bound_law.hpp"

namespace lightcuts::test {
namespace {

TEST(OrientedBound, IsNeverBelowAnyLight) { expect_bounds_hold_over_all_materials<OrientedPointLight<>>(4); }

TEST(OrientedBound, IsNeverBelowAnyLightWithItsOwnFalloff) {
    expect_bounds_hold_over_all_materials<OrientedPointLight<glm::vec3, PolynomialFalloff>>(5);
}

// All axes but one point away from the receiver, and that one barely reaches it: the cone of axes decides.
TEST(OrientedBound, IsNotZeroWhereTheRimOfTheConeOfAxesGrazes) {
    Random random(6);
    LawOutcome outcome;
    for (int trial = 0; trial < 200000; ++trial) {
        const glm::vec3 position(random.on_sphere() * random.between(0.5, 3.0));
        const glm::dvec3 towards = glm::normalize(glm::dvec3(position));
        const glm::vec3 rim(grazing(random, towards));
        const double beta = random.between(0.01, 2.5);
        const glm::vec3 away(glm::normalize(glm::dvec3(rim)) * std::cos(beta) + towards * std::sin(beta));
        ClusterConfiguration c;
        c.normal = glm::vec3(random.near(towards, 0.3));
        c.positions = {position, position};
        c.axes = {rim, glm::vec3(glm::normalize(glm::dvec3(away)))};
        c.intensities = {glm::vec3(1.0f), glm::vec3(1.0f)};
        const std::vector<OrientedPointLight<>> lights{{c.positions[0], c.axes[0], c.intensities[0]},
                                                       {c.positions[1], c.axes[1], c.intensities[1]}};
        check_cluster(outcome, c, lights, Lambert<glm::vec3>{c.normal, glm::vec3(1.0f)});
    }
    EXPECT_EQ(outcome.violations, 0u) << outcome.first;
}

}  // namespace
}  // namespace lightcuts::test
