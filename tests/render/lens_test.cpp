#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <render/pixel_filter.hpp>
#include <render/view.hpp>

namespace {

using render::Camera;

Camera some_camera() {
    Camera camera;
    camera.eye = {1.0, 2.0, 5.0};
    camera.target = {0.0, 0.0, 0.0};
    return camera;
}

TEST(Lens, RaysOfAPixelMeetWhereItIsSharp) {
    for (const bool orthographic : {false, true}) {
        Camera camera = some_camera();
        if (orthographic) camera.height = 3.0;
        const render::View view(camera, glm::dvec3(0.0), 40, 30, {.aperture = 0.5, .focus = 4.0});
        const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
        for (const auto& [x, y] : {std::pair(3.0f, 4.0f), std::pair(20.0f, 15.0f), std::pair(39.0f, 1.0f)}) {
            const auto sharp_point = [&](const render::EyeRay& ray) {
                const double along = (4.0 - glm::dot(glm::dvec3(ray.origin) - camera.eye, forward)) /
                                     glm::dot(glm::dvec3(ray.direction), forward);
                return glm::dvec3(ray.origin) + along * glm::dvec3(ray.direction);
            };
            const glm::dvec3 middle = sharp_point(view.ray(x, y));
            double farthest = 0.0;
            for (int i = 0; i < 64; ++i) {
                const render::EyeRay ray = view.ray(x, y, render::lens_sample(1, 5, i, 64).lens);
                EXPECT_LT(glm::distance(sharp_point(ray), middle), 1e-5);
                farthest = std::max(farthest, glm::distance(glm::dvec3(ray.origin), glm::dvec3(view.ray(x, y).origin)));
            }
            EXPECT_LE(farthest, 0.25 + 1e-6);
            EXPECT_GT(farthest, 0.23);
        }
    }
}

TEST(Lens, OneRayGoesThroughItsCenter) {
    const Camera camera = some_camera();
    const render::View pinhole(camera, glm::dvec3(0.0), 40, 30);
    const render::View lens(camera, glm::dvec3(0.0), 40, 30, {.aperture = 0.5, .focus = 4.0});
    const render::LensSample at = render::lens_sample(1, 7, 0, 1);
    EXPECT_EQ(at.offset, glm::vec2(0.5f));
    EXPECT_LT(glm::distance(lens.ray(3.5f, 2.5f, at.lens).direction, pinhole.ray(3.5f, 2.5f).direction), 1e-6f);
    EXPECT_EQ(lens.ray(3.5f, 2.5f, at.lens).origin, pinhole.ray(3.5f, 2.5f).origin);
}

TEST(Lens, SamplesCoverFourDimensionsEvenly) {
    // In each of 16 boxes as many of 4096 points as belong there, within what 16 random ones would be off by.
    std::array<int, 16> counts{};
    for (int i = 0; i < 4096; ++i) {
        const render::LensSample s = render::lens_sample(3, 11, i, 4096);
        const auto half = [](float x) { return x < 0.5f ? 0u : 1u; };
        ++counts[8 * half(s.offset.x) + 4 * half(s.offset.y) + 2 * half(s.lens.x) + half(s.lens.y)];
    }
    for (const int count : counts) EXPECT_NEAR(count, 256, 16);
}

/// Variance of a filter that is `weight(x)` high, x from -1.5 to 1.5.
template <class F>
double variance_of(const F& weight) {
    double sum = 0.0, squares = 0.0;
    for (int i = 0; i < 30'000; ++i) {
        const double x = -1.5 + 3.0 * (i + 0.5) / 30'000;
        sum += weight(x);
        squares += weight(x) * x * x;
    }
    return squares / sum;
}

TEST(PixelFilter, RaysAreAsDenseAsItIsHigh) {
    const auto variance = [](const std::string& filter) {
        double squares = 0.0, sum = 0.0;
        constexpr int count = 20'000;
        for (int i = 0; i < count; ++i) {
            const glm::vec2 p = render::PixelFilter(filter)(glm::vec2((static_cast<float>(i) + 0.5f) / count, 0.3f));
            const double x = static_cast<double>(p.x) - 0.5;
            sum += x;
            squares += x * x;
        }
        EXPECT_NEAR(sum / count, 0.0, 1e-5) << filter;
        return squares / count;
    };
    EXPECT_NEAR(variance("box"), 1.0 / 12.0, 1e-5);
    EXPECT_NEAR(variance("gaussian"), variance_of([](double x) { return std::exp(-2 * x * x) - std::exp(-4.5); }),
                1e-4);
    EXPECT_NEAR(variance("blackman-harris"), variance_of([](double x) {
                    const double t = 3.14159265358979 * (x / 1.5 + 1.0);
                    return 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) - 0.01168 * std::cos(3 * t);
                }),
                1e-4);
    for (const std::string& filter : render::pixel_filters()) {
        const glm::vec2 middle = render::PixelFilter(filter)(glm::vec2(0.5f));
        EXPECT_NEAR(middle.x, 0.5f, 1e-5f) << filter;
        EXPECT_NEAR(middle.y, 0.5f, 1e-5f) << filter;
    }
}

}  // namespace
