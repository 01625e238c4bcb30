#include <string>

#include <gtest/gtest.h>
#include <render/view.hpp>

#include "refusal.hpp"

namespace {

using render::Camera;

std::string refusal_of(const Camera& camera) {
    return refusal([&] { render::require_usable(camera, "here"); });
}

Camera looking(const glm::dvec3& eye, const glm::dvec3& target) {
    Camera camera;
    camera.eye = eye;
    camera.target = target;
    camera.up = render::default_up(eye, target);
    return camera;
}

TEST(View, RefusesCamerasForWhatIsWrongWithThem) {
    EXPECT_NE(refusal_of(looking({0, 1e20, 0}, {0, 0, 0})).find("farther away than 1e18"), std::string::npos);
    EXPECT_NE(refusal_of(looking({0, 1e200, 0}, {0, 0, 0})).find("farther away than 1e18"), std::string::npos);
    EXPECT_NE(refusal_of(looking({0, 0, 0}, {0, 0, 1e-200})).find("nearer to the eye"), std::string::npos);
    Camera camera = looking({0, 0, 3}, {0, 0, 0});
    camera.up = {0, 0, 1};
    EXPECT_NE(refusal_of(camera).find("does not cross the view"), std::string::npos);
    camera.up = {0, 0, 0};
    EXPECT_NE(refusal_of(camera).find("has no length"), std::string::npos);
}

TEST(View, TakesAllOtherLengths) {
    for (const double distance : {1e-140, 1e-45, 1e-9, 1.0, 1e9, 0.9e18}) {
        for (const glm::dvec3& way : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0.6, 0, 0.8)}) {
            for (const float upright : {1e-40f, 1.0f, 1e38f}) {
                Camera camera = looking(distance * way, {0, 0, 0});
                camera.up *= upright;
                EXPECT_NO_THROW(render::require_usable(camera, "here")) << distance;
                const render::View view(camera, camera.eye, 1, 1);
                const glm::vec3 direction = view.ray(0.5f, 0.5f).direction;
                for (int c = 0; c < 3; ++c) EXPECT_NEAR(direction[c], -way[c], 1e-6) << distance;
            }
        }
    }
}

}  // namespace
