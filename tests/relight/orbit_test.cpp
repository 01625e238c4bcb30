#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <relight/orbit.hpp>
#include <render/view.hpp>

namespace {

constexpr double near_enough = 1e-9;

render::Camera start_camera() {
    render::Camera camera;
    camera.eye = {1.0, 2.0, 9.0};
    camera.target = {1.0, 2.0, 5.0};
    camera.up = {0.0f, 1.0f, 0.0f};
    camera.vertical_fov = 40.0f;
    return camera;
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b) { EXPECT_LT(glm::length(a - b), near_enough); }

TEST(Orbit, StartsAndStartsAgainAtTheCameraToTheLastBit) {
    const render::Camera camera = start_camera();
    relight::Orbit orbit(camera, 7.0);
    EXPECT_EQ(orbit.camera().eye, camera.eye);
    EXPECT_EQ(orbit.camera().target, camera.target);
    orbit.turn(30.0, 20.0);
    orbit.approach(0.3);
    orbit.shift(0.1, 0.2);
    EXPECT_NE(orbit.camera().eye, camera.eye);
    orbit.reset();
    EXPECT_EQ(orbit.camera().eye, camera.eye);
    EXPECT_EQ(orbit.camera().target, camera.target);
    EXPECT_EQ(orbit.distance(), 7.0);
}

TEST(Orbit, TurnsCounterClockwiseAboutTheMiddle) {
    relight::Orbit orbit(start_camera(), 7.0);
    orbit.turn(90.0, 0.0);
    expect_near(orbit.camera().target, {1.0, 2.0, 2.0});
    expect_near(orbit.camera().eye, {8.0, 2.0, 2.0});
    orbit.turn(0.0, 30.0);
    expect_near(orbit.camera().eye, {1.0 + 7.0 * std::cos(std::numbers::pi / 6.0), 5.5, 2.0});
    for (int i = 0; i < 36; ++i) orbit.turn(10.0, 0.0);
    expect_near(orbit.camera().eye, {1.0 + 7.0 * std::cos(std::numbers::pi / 6.0), 5.5, 2.0});
}

TEST(Orbit, StaysADegreeAwayFromThePoles) {
    for (const double up : {500.0, -500.0}) {
        relight::Orbit orbit(start_camera(), 4.0);
        orbit.turn(0.0, up);
        const glm::dvec3 out = glm::normalize(orbit.camera().eye - orbit.camera().target);
        EXPECT_NEAR(std::asin(std::abs(out.y)) * 180.0 / std::numbers::pi, 89.0, 1e-6);
        render::require_usable(orbit.camera(), "orbit");
        // And it leads back down.
        orbit.turn(0.0, -up / std::abs(up) * 89.0);
        expect_near(orbit.camera().eye, {1.0, 2.0, 9.0});
    }
}

TEST(Orbit, CameraNearerToThePoleDoesNotJump) {
    render::Camera camera = start_camera();
    camera.eye = {1.0, 12.0, 5.05};
    relight::Orbit orbit(camera, glm::length(camera.eye - camera.target));
    orbit.turn(0.0, 5.0);
    expect_near(orbit.camera().eye, camera.eye);
    orbit.turn(0.0, -45.0);
    EXPECT_LT(orbit.camera().eye.y, 10.0);
}

TEST(Orbit, ApproachesTheMiddle) {
    relight::Orbit orbit(start_camera(), 8.0);
    orbit.approach(0.5);
    expect_near(orbit.camera().eye, {1.0, 2.0, 5.0});
    expect_near(orbit.camera().target, {1.0, 2.0, 1.0});
    for (int i = 0; i < 100; ++i) orbit.approach(0.5);
    EXPECT_GT(orbit.distance(), 7e-6);
    render::Camera flat = start_camera();
    flat.height = 3.0;
    relight::Orbit level(flat, 8.0);
    level.approach(0.5);
    EXPECT_EQ(level.camera().height, 1.5);
    EXPECT_EQ(level.camera().eye, flat.eye);
}

TEST(Orbit, ShiftMovesTheMiddleByThatShareOfThePicture) {
    for (const double height : {0.0, 3.0}) {
        render::Camera camera = start_camera();
        camera.height = height;
        relight::Orbit orbit(camera, 7.0);
        orbit.shift(0.25, 0.125);
        const render::View view(orbit.camera(), glm::dvec3(0.0), 200, 100);
        const render::EyeRay ray = view.ray(100.0f - 25.0f, 50.0f + 12.5f);
        const glm::dvec3 to_middle = glm::dvec3(1.0, 2.0, 2.0) - glm::dvec3(ray.origin);
        const glm::dvec3 along(ray.direction);
        EXPECT_LT(glm::length(to_middle - glm::dot(to_middle, along) * along), 1e-5);
    }
}

}  // namespace
