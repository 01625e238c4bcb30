#include <string>

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
    camera.eye = eye;
    camera.target = target;
    camera.up = render::default_up(eye, target);
    return camera;
}

TEST(View, RefusesDistancesThatFloatsCannotSquareByName) {
    EXPECT_NE(refusal_of(looking({0, 1e20f, 0}, {0, 0, 0})).find("1e+20 from the eye"), std::string::npos);
    EXPECT_NE(refusal_of(looking({3e38f, 0, 0}, {-3e38f, 0, 0})).find("6e+38 from the eye"), std::string::npos);
    EXPECT_NE(refusal_of(looking({0, 0, 0}, {0, 0, 1e-45f})).find("1.4013e-45 from the eye"), std::string::npos);
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
            const glm::vec3 direction = render::View(camera, 1, 1).ray(0.5f, 0.5f).direction;
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(direction[c], -way[c], 1e-6f) << distance;
        }
    }
}

}  // namespace
