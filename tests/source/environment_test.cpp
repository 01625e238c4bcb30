#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <lightcuts/source/environment.hpp>
#include "support/random.hpp"
#include "support/statistics.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;

struct Picture {
    std::uint32_t width, height;
    std::vector<V> pixels;

    EnvironmentMap<RowMajorPixels<V>> map(float scale = 1.0f, float rotation = 0.0f) const {
        return {width, height, {pixels.data(), width}, scale, rotation};
    }
    V& at(std::uint32_t x, std::uint32_t y) { return pixels[y * width + x]; }
};

/// A sky whose colors vary a thousandfold, with a black patch.
Picture clouds(std::uint32_t height, std::uint64_t seed) {
    Random random(seed);
    Picture picture{2 * height, height, {}};
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < 2 * height; ++x) {
            const double power = random.decades(-1.5, 1.5);
            const bool dark = x > height && x < height + height / 3;
            picture.pixels.push_back(dark ? V(0.0f)
                                          : V(power * random.unit(), power * random.unit(), power * random.unit()));
        }
    }
    return picture;
}

/// Irradiance of all pixels per channel, by the definition.
glm::dvec3 power_of(const EnvironmentMap<RowMajorPixels<V>>& map) {
    glm::dvec3 sum(0.0);
    for (std::uint32_t y = 0; y < map.height; ++y) {
        const double top = std::numbers::pi * (0.5 - double(y) / map.height);
        const double bottom = std::numbers::pi * (0.5 - (y + 1.0) / map.height);
        const double angle = 2.0 * std::numbers::pi / map.width * (std::sin(top) - std::sin(bottom));
        for (std::uint32_t x = 0; x < map.width; ++x) sum += angle * glm::dvec3(map.pixels(x, y));
    }
    return sum * double(map.scale);
}

template <class Lights>
glm::dvec3 power_of(const Lights& lights) {
    glm::dvec3 sum(0.0);
    for (const auto& l : lights) sum += glm::dvec3(l.intensity);
    return sum;
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "coordinate " << i;
}

TEST(EnvironmentMap, LooksAlongZInItsMiddleAndRunsClockwiseFromPiToMinusPi) {
    const auto map = Picture{8, 4, std::vector<V>(32, V(1.0f))}.map();
    expect_near(map.direction_at({4.0, 2.0}), {0.0, 0.0, 1.0}, 1e-15);
    expect_near(map.direction_at({2.0, 2.0}), {1.0, 0.0, 0.0}, 1e-15);  // longitude pi/2
    expect_near(map.direction_at({6.0, 2.0}), {-1.0, 0.0, 0.0}, 1e-15);
    expect_near(map.direction_at({0.0, 2.0}), {0.0, 0.0, -1.0}, 1e-15);
    expect_near(map.direction_at({3.0, 0.0}), {0.0, 1.0, 0.0}, 1e-15);
    expect_near(map.direction_at({3.0, 4.0}), {0.0, -1.0, 0.0}, 1e-15);
    // Counter-clockwise seen from above (+x to the right, +z down): what was along +z turns towards +x.
    const auto turned = Picture{8, 4, std::vector<V>(32, V(1.0f))}.map(1.0f, 90.0f);
    expect_near(turned.direction_at({4.0, 2.0}), {1.0, 0.0, 0.0}, 1e-15);
}

TEST(EnvironmentMap, FindsThePixelOfADirection) {
    Picture picture = clouds(16, 1);
    const auto map = picture.map(2.0f, 37.0f);
    double sphere = 0.0;
    for (std::uint32_t y = 0; y < 16; ++y) {
        for (std::uint32_t x = 0; x < 32; ++x) {
            const glm::dvec2 p(x + 0.3, y + 0.6);
            const glm::dvec3 d = map.direction_at(p);
            EXPECT_NEAR(glm::length(d), 1.0, 1e-14);
            const glm::dvec2 q = map.point_at(d);
            EXPECT_NEAR(q.x, p.x, 1e-9);
            EXPECT_NEAR(q.y, p.y, 1e-9);
            EXPECT_EQ(map.radiance(d), picture.at(x, y) * 2.0f);
            sphere += map.solid_angle(y);
        }
    }
    EXPECT_NEAR(sphere, 4.0 * std::numbers::pi, 1e-12);
    for (const double up : {-1.0, 1.0}) map.radiance({0.0, up, 0.0});  // in range at the poles
}

TEST(EnvironmentLights, KeepThePowerOfEveryChannelAndAreExactlyAsMany) {
    for (const std::size_t count : {1u, 2u, 17u, 300u, 5000u}) {
        const Picture picture = clouds(32, count);
        const auto map = picture.map(0.7f, 200.0f);
        const auto lights = environment_lights(map, count);
        ASSERT_EQ(lights.size(), count);
        const glm::dvec3 kept = power_of(lights), truth = power_of(map);
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(kept[i] / truth[i], 1.0, 1e-5);
        for (const auto& l : lights) {
            EXPECT_NEAR(channel_sum(l.intensity) * double(count) / channel_sum(V(truth)), 1.0, 1e-5) << "equal power";
            EXPECT_NEAR(glm::length(l.direction), 1.0f, 1e-6f);
            EXPECT_GT(channel_sum(map.radiance(-glm::dvec3(l.direction))), 0.0) << "at a lit pixel";
        }
    }
    EXPECT_TRUE(environment_lights(clouds(8, 1).map(), 0).empty());
}

TEST(EnvironmentLights, AreTheSameEveryTimeAndDifferBySeed) {
    const Picture picture = clouds(16, 3);
    const auto a = environment_lights(picture.map(), 100), b = environment_lights(picture.map(), 100);
    const auto other = environment_lights(picture.map(), 100, CenteredSobol{1});
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].direction, b[i].direction);
        EXPECT_EQ(a[i].intensity, b[i].intensity);
        different += a[i].direction != other[i].direction ? 1u : 0u;
    }
    EXPECT_GT(different, 90u);
}

TEST(EnvironmentLights, NeverLoseTheSun) {
    // One pixel has 0.5 to 100 times the power of all others, at a random place.
    Random random(4);
    for (const double ratio : {0.5, 3.0, 100.0}) {
        for (const std::size_t count : {10u, 64u, 1000u}) {
            Picture picture{128, 64, std::vector<V>(128 * 64, V(0.2f, 0.3f, 0.5f))};
            const auto x = static_cast<std::uint32_t>(random.below(128)),
                       y = static_cast<std::uint32_t>(random.below(64));
            const double pixel = picture.map().solid_angle(y);
            const double sky = power_of(picture.map()).x / 0.2;
            picture.at(x, y) = V(float(ratio * sky / 3.0 / pixel));
            const auto map = picture.map();
            const double sun = channel_sum(picture.at(x, y)) * pixel, all = channel_sum(V(power_of(map)));
            double found = 0.0;
            for (const auto& l : environment_lights(map, count)) {
                const glm::dvec2 p = map.point_at(-glm::dvec3(l.direction));
                const bool inside = std::fabs(p.x - x - 0.5) < 0.501 && std::fabs(p.y - y - 0.5) < 0.501;
                if (inside) found += channel_sum(l.intensity);
            }
            EXPECT_NEAR(found / all, sun / all, 2.0 / double(count)) << "ratio " << ratio << ", lights " << count;
        }
    }
}

TEST(EnvironmentLights, SpreadEvenlyWithinOnePixel) {
    Picture picture{16, 8, std::vector<V>(128, V(0.0f))};
    picture.at(5, 3) = V(1.0f);
    const auto map = picture.map();
    std::vector<int> quarters(16, 0);
    for (const auto& l : environment_lights(map, 256)) {
        const glm::dvec2 p = map.point_at(-glm::dvec3(l.direction)) - glm::dvec2(5.0, 3.0);
        ASSERT_TRUE(p.x > -1e-5 && p.x < 1.00001 && p.y > -1e-5 && p.y < 1.00001);
        const auto cell = [](double c) { return std::min(3, std::max(0, int(4.0 * c))); };
        ++quarters[static_cast<std::size_t>(4 * cell(p.y) + cell(p.x))];
    }
    for (const int n : quarters) EXPECT_NEAR(n, 16, 2);
}

/// Irradiance on a plane with normal `n`, of all lights.
double irradiance(const std::vector<DistantLight<V>>& lights, const glm::dvec3& n) {
    double sum = 0.0;
    for (const auto& l : lights) {
        const double cosine = -glm::dot(glm::dvec3(l.direction), n);
        if (cosine > 0.0) sum += cosine * channel_sum(l.intensity);
    }
    return sum;
}

TEST(EnvironmentLights, OfAUniformSkyLightAPlaneByPiFromEverySide) {
    const Picture white{256, 128, std::vector<V>(256 * 128, V(1.0f / 3.0f))};
    const auto lights = environment_lights(white.map(), 1024);
    Random random(5);
    for (int i = 0; i < 50; ++i) {
        // Independent directions would be off by 4 % (a deviation of sqrt(5/3 / 1024)).
        EXPECT_NEAR(irradiance(lights, random.on_sphere()) / std::numbers::pi, 1.0, 0.006);
    }
}

TEST(EnvironmentLights, AreUnbiasedOverSeeds) {
    Picture picture = clouds(16, 6);
    for (V& p : picture.pixels) p = V(p.x);  // of proportional spectra
    picture.at(20, 4) = V(1000.0f);
    const auto map = picture.map();
    const glm::dvec3 n = glm::normalize(glm::dvec3(0.3, 0.8, -0.4));
    double truth = 0.0;  // by 16 x 16 points a pixel
    for (std::uint32_t y = 0; y < 16 * 16; ++y) {
        for (std::uint32_t x = 0; x < 32 * 16; ++x) {
            const double cosine = glm::dot(n, map.direction_at({(x + 0.5) / 16.0, (y + 0.5) / 16.0}));
            if (cosine <= 0.0) continue;
            truth += cosine * channel_sum(picture.at(x / 16, y / 16)) * map.solid_angle(y / 16) / 256.0;
        }
    }
    Mean mean;
    for (std::uint64_t seed = 0; seed < 4000; ++seed)
        mean.add(irradiance(environment_lights(map, 8, ScrambledSobol{seed}), n));
    // Pixels are sampled evenly in latitude, not in its sine: 0.1 % here.
    EXPECT_NEAR(mean.value() / truth, 1.0, 0.001 + one_in_a_million * mean.deviation() / std::sqrt(4000.0) / truth);
}

std::string refusal(const Picture& picture) {
    try {
        environment_lights(picture.map(), 10);
    } catch (const invalid_input& e) { return e.what(); }
    return "";
}

TEST(EnvironmentLights, RefuseWhatIsNoMap) {
    using testing::HasSubstr;
    const auto white = [](std::uint32_t w, std::uint32_t h) { return Picture{w, h, std::vector<V>(w * h, V(1.0f))}; };
    EXPECT_THAT(refusal(white(10, 10)), HasSubstr("10 x 10 pixels are not twice as wide as high"));
    EXPECT_THAT(refusal(white(0, 0)), HasSubstr("0 x 0"));
    EXPECT_THAT(refusal(Picture{8, 4, std::vector<V>(32, V(0.0f))}), HasSubstr("all pixels are black"));
    for (const auto& [value, word] : {std::pair{-1.0f, "negative"},
                                      {std::numeric_limits<float>::infinity(), "not finite"},
                                      {std::numeric_limits<float>::quiet_NaN(), "not finite"}}) {
        Picture picture = white(8, 4);
        picture.at(5, 2).y = value;
        EXPECT_THAT(refusal(picture), HasSubstr("pixel (5, 2)"));
        EXPECT_THAT(refusal(picture), HasSubstr(word));
    }
    EXPECT_EQ(refusal(white(8, 4)), "");
}

TEST(EnvironmentLights, TakeAnyPixelsAndSpectrum) {
    const EnvironmentMap map(8, 4, [](std::uint32_t x, std::uint32_t) { return x < 4 ? 1.0f : 0.0f; });
    const auto lights = environment_lights(map, 40, IndependentSampler{2});
    ASSERT_EQ(lights.size(), 40u);
    double power = 0.0;
    for (const DistantLight<float>& l : lights) {
        power += double(l.intensity);
        EXPECT_LE(l.direction.x, 1e-6f) << "the left half of the map is at positive longitudes";
    }
    EXPECT_NEAR(power, 2.0 * std::numbers::pi, 1e-5);
}

}  // namespace
}  // namespace lightcuts::test
