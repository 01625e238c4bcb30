#include <numbers>

#include <gtest/gtest.h>
#include <lightcuts/core/invalid_input.hpp>

#include "render/refusal.hpp"
#include "small_world.hpp"

namespace {

TEST(Illumination, NothingOfTheMapIsLost) {
    const auto points = lightcuts::even_directions(1000);
    const relight::NearestDirection nearest(points);
    std::vector<glm::vec3> power(points.size());
    for (const int width : {8, 64, 1024}) {
        const render::Picture map = small_map(width);
        const render::Environment environment{map, 1.0f, 0.0f};
        glm::dvec3 expected(0.0);
        for (std::uint32_t y = 0; y < static_cast<std::uint32_t>(map.height); ++y) {
            for (std::uint32_t x = 0; x < static_cast<std::uint32_t>(map.width); ++x) {
                expected += glm::dvec3(environment.map().pixels(x, y)) * environment.map().solid_angle(y);
            }
        }
        for (const double degrees : {0.0, 33.3, -720.0}) {
            relight::SplitMap(map, 1.0f, points.size(), "map").turn(degrees, nearest, power);
            glm::dvec3 sum(0.0);
            for (const glm::vec3& p : power) sum += glm::dvec3(p);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c] / expected[c], 1.0, 1e-5) << width << " " << degrees;
        }
    }
}

TEST(Illumination, UniformMapGivesEachDirectionAboutItsShare) {
    const auto points = lightcuts::even_directions(2000);
    const relight::NearestDirection nearest(points);
    std::vector<glm::vec3> power(points.size());
    render::Picture map(256, 128);
    map.pixels.assign(map.pixels.size(), glm::vec3(1.0f));
    relight::SplitMap(map, 2.0f, points.size(), "map").turn(10.0, nearest, power);
    double squares = 0.0;
    for (const glm::vec3& p : power) {
        const double off = static_cast<double>(p.x) / (2.0 * 4.0 * std::numbers::pi / 2000.0) - 1.0;
        squares += off * off;
    }
    // A direction gets whole pixels, some thirty.
    EXPECT_LT(std::sqrt(squares / 2000.0), 0.2);
}

TEST(Illumination, TurnedMapIsTheTurnedFile) {
    const auto points = lightcuts::even_directions(700);
    const relight::NearestDirection nearest(points);
    const render::Picture map = small_map(64);
    render::Picture shifted = map;
    // Columns run against the longitude: a turn by 8 of 64 moves them to the left.
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            shifted.pixels[static_cast<std::size_t>(y * 64 + x)] =
                map.pixels[static_cast<std::size_t>(y * 64 + (x + 8) % 64)];
        }
    }
    std::vector<glm::vec3> turned(points.size()), of_file(points.size());
    relight::SplitMap(map, 1.0f, points.size(), "map").turn(45.0, nearest, turned);
    relight::SplitMap(shifted, 1.0f, points.size(), "map").turn(0.0, nearest, of_file);
    EXPECT_LT(relative_difference(turned, of_file), 1e-5);
    // And that is what the background shows.
    const render::Environment by_option{map, 1.0f, 45.0f}, by_file{shifted, 1.0f, 0.0f};
    for (const glm::vec3& d : points) {
        EXPECT_EQ(by_option.map().radiance(glm::dvec3(d)), by_file.map().radiance(glm::dvec3(d)));
    }
}

TEST(Illumination, LightComesFromWhereTheMapShowsIt) {
    const auto points = lightcuts::even_directions(3000);
    const relight::NearestDirection nearest(points);
    render::Picture map(64, 32);
    map.pixels[10 * 64 + 20] = glm::vec3(1.0f);
    const render::Environment environment{map, 1.0f, 70.0f};
    std::vector<glm::vec3> power(points.size());
    relight::SplitMap(map, 1.0f, points.size(), "map").turn(70.0, nearest, power);
    const glm::dvec3 towards = environment.map().direction_at({20.5, 10.5});
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (power[i] == glm::vec3(0.0f)) continue;
        EXPECT_GT(glm::dot(glm::dvec3(points[i]), towards), std::cos(0.15));
    }
}

TEST(Illumination, NearestDirectionIsThatOfACellNearby) {
    for (const std::size_t count : {1u, 16u, 300u, 5000u}) {
        const auto points = lightcuts::even_directions(count, 1);
        const relight::NearestDirection nearest(points);
        for (const glm::vec3& d : lightcuts::even_directions(500, 7)) {
            double best = -2.0;
            for (const glm::vec3& p : points) best = std::max(best, glm::dot(glm::dvec3(p), glm::dvec3(d)));
            const double found = glm::dot(glm::dvec3(points[nearest(glm::dvec3(d))]), glm::dvec3(d));
            // Within the size of a cell, which is a quarter of the distance of neighbors.
            EXPECT_LT(std::acos(std::min(found, 1.0)) - std::acos(std::min(best, 1.0)),
                      3.0 / std::sqrt(static_cast<double>(count)));
        }
    }
}

TEST(Illumination, MeansAreExactAtEveryCluster) {
    const auto directions = relight::geometric_directions(lightcuts::even_directions(300));
    std::vector<glm::vec3> power(300);
    for (std::size_t i = 0; i < power.size(); ++i) power[i] = glm::vec3(static_cast<float>(i % 17), 1.0f, 0.5f);
    relight::Illumination illumination(directions);
    illumination.set(power, {.size = 40, .cluster_angle = 60.0});
    EXPECT_EQ(illumination.cut().size(), 40u);
    double sum = 0.0;
    for (const glm::vec3& p : power) sum += static_cast<double>(p.x);
    EXPECT_NEAR(illumination.light(directions.tree.root()).power.x, sum, 1e-3);
    for (const lightcuts::Piece& piece : illumination.cut().pieces()) {
        EXPECT_LE(directions.clusters[piece.node()].radius, 60.0 * std::numbers::pi / 180.0 + 1e-6);
    }
}

TEST(Illumination, BadMapsAreRefused) {
    render::Picture map = small_map();
    map.pixels[40].y = std::numeric_limits<float>::quiet_NaN();
    const std::string message = refusal([&] { relight::SplitMap(map, 1.0f, 100, "sky.hdr"); });
    EXPECT_NE(message.find("sky.hdr"), std::string::npos) << message;
    EXPECT_NE(message.find("pixel (8, 1)"), std::string::npos) << message;
    render::Picture square(16, 16);
    square.pixels.assign(square.pixels.size(), glm::vec3(1.0f));
    EXPECT_NE(refusal([&] { relight::SplitMap(square, 1.0f, 100, "m"); }).find("twice as wide"), std::string::npos);
}

}  // namespace
