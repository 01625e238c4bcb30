#include <type_traits>

#include <gtest/gtest.h>

#include <lightcuts/light/directional.hpp>
#include <lightcuts/light/incidence.hpp>
#include <lightcuts/light/omni.hpp>
#include <lightcuts/light/oriented.hpp>
#include <lightcuts/light/spot.hpp>

namespace lightcuts::test {
/// Says everything three times.
struct Verbose {
    glm::vec3 position{1.0f};
    float intensity() const { return 2.0f; }
    glm::vec3 axis{1.0f, 0.0f, 0.0f};
};
/// Cannot be edited, and its members mean something else.
struct Foreign {
    float position;
    glm::vec3 where;
    double watts;
};
}  // namespace lightcuts::test

template <>
struct lightcuts::light_traits<lightcuts::test::Verbose> {
    static glm::vec3 position(const lightcuts::test::Verbose&) { return glm::vec3(3.0f); }
    static float falloff(const lightcuts::test::Verbose&, float distance) { return 1.0f / distance; }
};
template <>
struct lightcuts::light_traits<lightcuts::test::Foreign> {
    static glm::vec3 position(const lightcuts::test::Foreign& l) { return l.where; }
    static double intensity(const lightcuts::test::Foreign& l) { return l.watts; }
};

namespace lightcuts::test {
namespace {

static_assert(PointLight<OmniLight<>> && !OrientedLight<OmniLight<>> && !FalloffLight<OmniLight<>> &&
              !DirectionalLight<OmniLight<>>);
static_assert(FalloffLight<OmniLight<float, PolynomialFalloff>>);
static_assert(OrientedLight<OrientedPointLight<>> && !ProfiledLight<OrientedPointLight<>>);
static_assert(ProfiledLight<SpotLight<>> && !FalloffLight<SpotLight<>>);
static_assert(DirectionalLight<DistantLight<>> && !PointLight<DistantLight<>>);
static_assert(PointLight<Foreign> && !OrientedLight<Foreign> && std::same_as<spectrum_of<Foreign>, double>);
static_assert(FalloffLight<Verbose> && OrientedLight<Verbose>);

// A falloff that every light shares takes no space.
static_assert(sizeof(OmniLight<>) == 24 && sizeof(OmniLight<float>) == 16);
static_assert(sizeof(OrientedPointLight<>) == 36);
static_assert(sizeof(OmniLight<glm::vec3, PolynomialFalloff>) == 36);

TEST(LightProperty, ComesFromTheTraitThenTheFunctionThenTheMember) {
    const Verbose light;
    EXPECT_EQ(position_or_direction(light), glm::vec3(3.0f));
    EXPECT_EQ(detail::intensity_of(light), 2.0f);
    EXPECT_EQ(detail::axis_of(light), glm::vec3(1.0f, 0.0f, 0.0f));
    EXPECT_EQ(position_or_direction(Foreign{1.0f, glm::vec3(7.0f), 2.0}), glm::vec3(7.0f));
}

TEST(PlaceOf, ADirectionalLightIsTheUnitDirectionTowardsIt) {
    EXPECT_EQ(position_or_direction(DistantLight<>{{0.0f, -1.0f, 0.0f}, {}}), glm::vec3(0.0f, 1.0f, 0.0f));
    const glm::vec3 place = position_or_direction(DistantLight<>{{0.6f, 0.0f, 0.8f}, {}});
    EXPECT_NEAR(glm::length(place), 1.0f, 1e-7f);
}

TEST(Incidence, OfAnOmniLightIsTheInverseSquare) {
    const Incidence i = incidence(OmniLight<>{{0.0f, 0.0f, 4.0f}, {}, {}}, {0.0f, 0.0f, 2.0f});
    EXPECT_DOUBLE_EQ(i.geometric, 0.25);
    EXPECT_EQ(i.to_light, glm::vec3(0.0f, 0.0f, 1.0f));
}

TEST(Incidence, OfAnOrientedLightHasItsCosine) {
    const glm::vec3 axis(0.6f, 0.0f, -0.8f);
    const Incidence i = incidence(OrientedPointLight<>{{0.0f, 0.0f, 2.0f}, axis, {}, {}}, glm::vec3(0.0f));
    EXPECT_NEAR(i.geometric, 0.8 / 4.0, 1e-7);
    EXPECT_EQ(incidence(OrientedPointLight<>{{0.0f, 0.0f, 2.0f}, -axis, {}, {}}, glm::vec3(0.0f)).geometric, 0.0);
}

TEST(Incidence, HasTheFalloffInPlaceOfTheInverseSquare) {
    const PolynomialFalloff falloff{1.0f, 0.5f, 0.25f};
    EXPECT_NEAR(
        incidence(OmniLight<float, PolynomialFalloff>{{0.0f, 2.0f, 0.0f}, 1.0f, falloff}, glm::vec3(0.0f)).geometric,
        1.0 / 3.0, 1e-7);
    const Incidence both = incidence(
        OrientedPointLight<float, PolynomialFalloff>{{0.0f, 2.0f, 0.0f}, {0.0f, -1.0f, 0.0f}, 1.0f, falloff},
        glm::vec3(0.0f));
    EXPECT_NEAR(both.geometric, 1.0 / 3.0, 1e-7);
}

TEST(Incidence, OfADirectionalLightIsOneEverywhere) {
    const DistantLight<> sun{{0.0f, -1.0f, 0.0f}, {}};
    for (const glm::vec3& x : {glm::vec3(0.0f), glm::vec3(1e30f), glm::vec3(-5.0f)}) {
        EXPECT_EQ(incidence(sun, x).geometric, 1.0);
        EXPECT_EQ(incidence(sun, x).to_light, glm::vec3(0.0f, 1.0f, 0.0f));
    }
}

TEST(Incidence, AtTheLightItselfIsNothing) {
    EXPECT_EQ(incidence(OmniLight<>{glm::vec3(1.0f), {}, {}}, glm::vec3(1.0f)).geometric, 0.0);
    EXPECT_EQ(incidence(SpotLight<>{glm::vec3(1.0f), {0.0f, 0.0f, 1.0f}, {}, {}}, glm::vec3(1.0f)).geometric, 0.0);
    const OmniLight<float, PolynomialFalloff> constant{glm::vec3(1.0f), 1.0f, {1.0f, 0.0f, 0.0f}};
    EXPECT_EQ(incidence(constant, glm::vec3(1.0f)).geometric, 0.0);
}

TEST(Incidence, NeitherOverflowsNorVanishes) {
    for (const float d : {1e-30f, 1e-20f, 1e-10f, 1e10f, 1e20f, 1e30f}) {
        const Incidence i = incidence(OmniLight<>{{d, 0.0f, 0.0f}, {}, {}}, glm::vec3(0.0f));
        const double square = static_cast<double>(d) * static_cast<double>(d);
        EXPECT_NEAR(i.geometric * square, 1.0, 1e-12) << d;
        EXPECT_EQ(i.to_light, glm::vec3(1.0f, 0.0f, 0.0f));
    }
}

}  // namespace
}  // namespace lightcuts::test
