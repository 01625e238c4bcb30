#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <render/view.hpp>

#include "refusal.hpp"

namespace {

using render::Camera;

std::string refusal_of(const Camera& camera) {
    return refusal([&] { render::require_usable(camera, "here"); });
}

Camera looking(const glm::vec3& eye, const glm::vec3& target) {
    Camera camera;
    camera.eye = glm::dvec3(eye);
    camera.target = glm::dvec3(target);
    camera.up = render::default_up(camera.eye, camera.target);
    return camera;
}

TEST(View, RefusesDistancesThatFloatsCannotSquareByName) {
    EXPECT_NE(refusal_of(looking({0, 1e20f, 0}, {0, 0, 0})).find("1e+20 from the eye"), std::string::npos);
    EXPECT_NE(refusal_of(looking({3e38f, 0, 0}, {-3e38f, 0, 0})).find("6e+38 from the eye"), std::string::npos);
    EXPECT_NE(refusal_of(looking({0, 0, 0}, {0, 0, 1e-45f})).find("1.4013e-45 from the eye"), std::string::npos);
    EXPECT_NE(refusal_of(looking({1e20f, 0, 0}, {1e20f, 1e17f, 0})).find("1e+20 from the origin"), std::string::npos);
    Camera camera = looking({0, 0, 3}, {0, 0, 0});
    camera.up = {0, 1e30f, 0};
    EXPECT_NE(refusal_of(camera).find("up vector's length is 1e+30"), std::string::npos);
    camera.up = {0, 0, 1};
    EXPECT_NE(refusal_of(camera).find("does not cross the view"), std::string::npos);
    camera.up = {0, 0, 0};
    EXPECT_NE(refusal_of(camera).find("does not cross the view"), std::string::npos);
}

TEST(View, TakesAllOtherDistances) {
    for (const float distance : {1.1e-18f, 1e-9f, 1.0f, 1e9f, 0.9e18f}) {
        for (const glm::vec3& way : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0.6f, 0, 0.8f)}) {
            const Camera camera = looking(distance * way, {0, 0, 0});
            EXPECT_NO_THROW(render::require_usable(camera, "here")) << distance;
            const glm::vec3 direction = render::View(camera, glm::dvec3(0.0), 1, 1).ray(0.5f, 0.5f).direction;
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(direction[c], -way[c], 1e-6f) << distance;
        }
    }
}

TEST(View, OfAnOrthographicCameraIsAGridOfParallelRays) {
    Camera camera;
    camera.eye = {1e6, 10.0, 0.0};
    camera.target = {1e6, 0.0, 0.0};
    camera.up = {0.0f, 0.0f, -1.0f};
    camera.height = 4.0;
    const render::View view(camera, {1e6, 0.0, 0.0}, 6, 2);
    for (const auto& [x, y] : {std::pair(0.0f, 0.0f), std::pair(6.0f, 2.0f), std::pair(1.5f, 0.25f)}) {
        const render::EyeRay ray = view.ray(x, y);
        EXPECT_EQ(ray.direction, glm::vec3(0, -1, 0));
        EXPECT_NEAR(ray.origin.x, 2.0f * (x - 3.0f), 1e-6f);
        EXPECT_NEAR(ray.origin.z, 2.0f * (y - 1.0f), 1e-6f);
        EXPECT_EQ(ray.origin.y, 10.0f);
    }
    camera.vertical_fov = 0.0f;
    EXPECT_NO_THROW(render::require_usable(camera, "here")) << "it has no field of view";
}

}  // namespace
