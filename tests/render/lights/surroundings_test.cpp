#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <render/io/map_picture.hpp>
#include <render/io/picture.hpp>
#include <render/lights/surroundings.hpp>

#include "render/programs.hpp"
#include "render/refusal.hpp"

namespace {

using render::Picture;
using testing::HasSubstr;

Picture constant_map(int height, const glm::vec3& radiance) {
    Picture map(2 * height, height);
    for (glm::vec3& pixel : map.pixels) pixel = radiance;
    return map;
}

/// One white pixel of radiance 100, the rest black.
Picture lamp_map(int height, int x, int y) {
    Picture map = constant_map(height, glm::vec3(0.0f));
    map.pixels[static_cast<std::size_t>(2 * height * y + x)] = glm::vec3(100.0f);
    return map;
}

/// A Radiance picture with pixels of one byte a channel and exponent, not compressed.
std::string hdr(int width, int height, const std::string& pixels) {
    return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " + std::to_string(width) +
           "\n" + pixels;
}

/// Scenes under the sky: a white floor, and a white wall in the plane x = 0.
class Surroundings : public Programs {
protected:
    void SetUp() override {
        Programs::SetUp();
        folder.write("white.mtl", "newmtl white\nKd 1 1 1\n");
        folder.write("white.obj",
                     "mtllib white.mtl\nv -4 0 -4\nv 4 0 -4\nv 4 0 4\nv -4 0 4\nusemtl white\nf 4 3 2 1\n");
        folder.write("wall.obj", "mtllib white.mtl\nv 0 -4 -4\nv 0 4 -4\nv 0 4 4\nv 0 -4 4\nusemtl white\nf 1 2 3 4\n");
    }
    Picture rendered(const std::string& arguments) {
        const auto result = render("--quiet " + arguments);
        EXPECT_EQ(result.status, 0) << arguments << ": " << result.err;
        return render::read_exr(folder / "render.exr");
    }
};

TEST_F(Surroundings, OfOneColorLightAWhiteFloorWithTheirRadiance) {
    write_exr(folder / "one.exr", constant_map(32, {1.0f, 2.0f, 0.5f}));
    for (const std::string method : {"exhaustive", "lightcuts"}) {
        const Picture floor = rendered("white.obj --env one.exr --size 8x6 --eye 0,3,0.1 --target 0,0,0 --method " +
                                       method);
        for (const glm::vec3& pixel : floor.pixels) {
            // 3000 directions as a quadrature of the cosine.
            const float allowed = method == "exhaustive" ? 0.003f : 0.02f;
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c] / glm::vec3(1.0f, 2.0f, 0.5f)[c], 1.0f, allowed) << method;
        }
    }
    const auto lights = report("render.json").at("lights");
    EXPECT_EQ(lights.at("environment"), 3000);
    EXPECT_EQ(lights.at("directional"), 0);

    const Picture sky = rendered("white.obj --env one.exr --env-scale 3 --size 8x6 --eye 0,3,0 --target 0,9,0.1");
    for (const glm::vec3& pixel : sky.pixels) EXPECT_EQ(pixel, glm::vec3(3.0f, 6.0f, 1.5f));
}

TEST_F(Surroundings, AreSeenInMirrorsAndThroughGlass) {
    write_exr(folder / "one.exr", constant_map(8, glm::vec3(2.0f)));
    folder.write("mirror.mtl", "newmtl mirror\nKd 0 0 0\nKs 0.5 0.25 1\nillum 5\n");
    folder.write("mirror.obj", "mtllib mirror.mtl\nv -4 0 -4\nv 4 0 -4\nv 4 0 4\nv -4 0 4\nusemtl mirror\nf 4 3 2 1\n");
    const Picture mirror = rendered("mirror.obj --env one.exr --size 4x4 --eye 0,3,0.1 --target 0,0,0");
    for (const glm::vec3& pixel : mirror.pixels) EXPECT_EQ(pixel, glm::vec3(1.0f, 0.5f, 2.0f));

    // What glass reflects and what it lets through see the same.
    folder.write("mirror.mtl", "newmtl mirror\nKd 0 0 0\nKs 1 1 1\nTf 1 1 1\nNi 1.5\nillum 7\n");
    const Picture glass = rendered("mirror.obj --env one.exr --size 4x4 --eye 0,3,0.1 --target 0,0,0");
    for (const glm::vec3& pixel : glass.pixels) EXPECT_NEAR(pixel.g, 2.0f, 1e-5f);
}

TEST_F(Surroundings, TurnCounterClockwiseSeenFromAbove) {
    // The lamp is one pixel of 10 degrees at longitude 5, latitude 5 degrees: just beside +z, towards +x.
    write_exr(folder / "lamp.exr", lamp_map(18, 17, 8));
    struct Turn {
        const char* degrees;
        double longitude;
        bool front;  ///< the side of the wall that faces +x is lit
    };
    for (const Turn& turn : {Turn{"0", 5, true}, {"90", 95, true}, {"-90", -85, false}, {"200", 205, false}}) {
        const std::string map = "--env lamp.exr --env-rotate " + std::string(turn.degrees);
        const Picture wall = rendered("wall.obj --size 4x4 --eye 5,0,0 --target 0,0,0 " + map);
        const double longitude = turn.longitude * std::numbers::pi / 180, latitude = std::numbers::pi / 36;
        const glm::dvec3 towards(std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                                 std::cos(longitude) * std::cos(latitude));
        const double solid_angle = std::numbers::pi / 18 * std::sin(std::numbers::pi / 18);
        const double expected = turn.front ? 100 / std::numbers::pi * towards.x * solid_angle : 0.0;
        // Wherever the lights stand in the pixel, its middle is within 5 degrees of them.
        const double allowed = expected == 0.0 ? 0.0 : 100 / std::numbers::pi * solid_angle * 0.005;
        EXPECT_NEAR(static_cast<double>(wall.pixels[5].r), expected, allowed) << turn.degrees;

        const auto look = [&](double to) {
            const glm::dvec3 at(std::sin(to) * 9.0, 9.0 * std::tan(latitude), std::cos(to) * 9.0);
            return rendered("white.obj --size 3x3 --fov 5 --eye 0,1,0 --target " + std::to_string(at.x) + "," +
                            std::to_string(at.y + 1.0) + "," + std::to_string(at.z) + " " + map)
                .pixels[4];
        };
        EXPECT_EQ(look(longitude), glm::vec3(100.0f)) << turn.degrees;
        EXPECT_EQ(look(longitude + std::numbers::pi / 9), glm::vec3(0.0f)) << turn.degrees;
        EXPECT_EQ(look(-longitude - std::numbers::pi / 9), glm::vec3(0.0f)) << turn.degrees;
    }
}

TEST_F(Surroundings, ReadRadiancePictures) {
    // 128 x 2^(129 - 136) = 1 a channel; blue is half of it.
    std::string pixels;
    for (int i = 0; i < 32; ++i) pixels += "\x80\x80\x40\x81";
    folder.write("sky.hdr", hdr(8, 4, pixels));
    const Picture sky = rendered("white.obj --env sky.hdr --env-lights 50 --size 2x2 --eye 0,3,0 --target 0,9,0.1");
    for (const glm::vec3& pixel : sky.pixels) EXPECT_EQ(pixel, glm::vec3(1.0f, 1.0f, 0.5f));
    EXPECT_EQ(report("render.json").at("lights").at("environment"), 50);

    folder.write("cut.hdr", hdr(8, 4, pixels.substr(0, 101)));
    EXPECT_THAT(refusal([&] { render::read_map(folder / "cut.hdr"); }), HasSubstr("cut short"));
}

TEST_F(Surroundings, HaveASunAtItsElevationAndAzimuth) {
    const lightcuts::SunSky daylight({30.0, 90.0, 4.0});
    // From a wall in the plane x = 0 the sun is at 30 degrees; the sky adds what a wall sees of it.
    const std::string sun = " --sun-sky 30,90 --turbidity 4 --ground 0 --size 4x4 --target 0,0,0 --method exhaustive ";
    const Picture front = rendered("wall.obj --sky-lights 0 --eye 5,0,0" + sun);
    const Picture behind = rendered("wall.obj --sky-lights 0 --eye -5,0,0" + sun);
    const Picture with_sky = rendered("wall.obj --eye 5,0,0" + sun);
    const auto lights = report("render.json").at("lights");
    EXPECT_EQ(lights.at("sun"), 64);
    EXPECT_EQ(lights.at("sky"), 5000);
    EXPECT_EQ(lights.at("directional"), 0);
    for (int c = 0; c < 3; ++c) {
        const float of_sun = daylight.sun_irradiance()[c] * std::numbers::inv_pi_v<float> * std::sqrt(0.75f);
        EXPECT_NEAR(front.pixels[5][c] / of_sun, 1.0f, 1e-3f);
        EXPECT_EQ(behind.pixels[5][c], 0.0f);
        // Irradiance of the sky on the wall by brute force.
        double of_sky = 0.0;
        constexpr int steps = 300;
        for (int i = 0; i < steps; ++i) {
            for (int j = 0; j < steps; ++j) {
                const double latitude = (i + 0.5) / steps * std::numbers::pi / 2;
                const double longitude = (j + 0.5) / steps * std::numbers::pi;
                const glm::dvec3 towards(std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                                         std::cos(longitude) * std::cos(latitude));
                const double angle = std::numbers::pi / 2 / steps * std::numbers::pi / steps * std::cos(latitude);
                of_sky += static_cast<double>(daylight.sky_radiance(towards)[c]) * towards.x * angle;
            }
        }
        of_sky /= std::numbers::pi;
        EXPECT_NEAR(static_cast<double>(with_sky.pixels[5][c] - front.pixels[5][c]) / of_sky, 1.0, 0.01);
    }

    // What is seen: half up to the zenith, into the sun, below the horizon.
    const auto look = [&](const std::string& target) {
        return rendered(
                   "white.obj --sun-sky 30,90 --turbidity 4 --ground 0 --size 1x1 --fov 0.01 --eye 0,5,0 --target " +
                   target)
            .pixels[0];
    };
    const glm::vec3 away = look("-3,8,0"), seen = daylight.radiance(glm::normalize(glm::dvec3(-1, 1, 0)));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(away[c] / seen[c], 1.0f, 1e-4f);
    EXPECT_GT(look("8.6602540,10,0").g, 1000.0f * away.g);
    EXPECT_EQ(look("20,4,0"), glm::vec3(0.0f));
}

TEST_F(Surroundings, HaveGroundThatLightsFromBelowAsItIsSeen) {
    const lightcuts::SunSky daylight({40.0, 130.0, 3.0}, glm::vec3(0.5f));
    const std::string sun = "white.obj --sun-sky 40,130 --size 4x4 --method exhaustive ";
    const std::string below = "--eye 0,-3,0.1 --target 0,0,0 ", above = "--eye 0,3,0.1 --target 0,0,0 ";
    // What looks down on the ground is as bright as it, being white.
    for (const glm::vec3& pixel : rendered(sun + below + "--ground 0.5").pixels) {
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(pixel[c] / daylight.ground_radiance()[c], 1.0f, 1e-3f);
    }
    const auto lights = report("render.json").at("lights");
    EXPECT_EQ(lights.at("sky"), 5000);
    EXPECT_EQ(lights.at("directional"), 0);
    EXPECT_FLOAT_EQ(report("render.json").at("options").at("ground").get<float>(), 0.5f);
    // Each of its lights has the power of one of the sky's.
    double sky = 0.0;
    for (const auto& light : lightcuts::sky_lights(daylight, 5000)) sky += lightcuts::channel_sum(light.intensity);
    const double ground = 2.0 * std::numbers::pi * lightcuts::channel_sum(daylight.ground_radiance());
    EXPECT_NEAR(lights.at("ground").get<double>() / (5000.0 * ground / sky), 1.0, 1e-3);

    for (const glm::vec3& pixel :
         rendered(sun + "--ground 0.5 --fov 20 --eye 0,-1,0 --target 3,-9,1 --sky-lights 100").pixels) {
        EXPECT_EQ(pixel, daylight.ground_radiance());
    }
    // What looks up sees none of it.
    const Picture with = rendered(sun + above);
    EXPECT_FLOAT_EQ(report("render.json").at("options").at("ground").get<float>(), 0.2f);
    EXPECT_GT(report("render.json").at("lights").at("ground"), 1000);
    const Picture without = rendered(sun + above + "--ground 0");
    EXPECT_EQ(report("render.json").at("lights").at("ground"), 0);
    for (std::size_t i = 0; i < with.size(); ++i) {
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(with.pixels[i][c] / without.pixels[i][c], 1.0f, 1e-6f);
    }
    for (const glm::vec3& pixel : rendered(sun + below + "--ground 0").pixels) EXPECT_EQ(pixel, glm::vec3(0.0f));
    // Like the sky, it is only seen if it has no lights.
    for (const glm::vec3& pixel : rendered(sun + below + "--sky-lights 0").pixels) EXPECT_EQ(pixel, glm::vec3(0.0f));
}

TEST_F(Surroundings, RefuseBadInputInOneLine) {
    const auto with_pixel = [&](const std::string& name, const glm::vec3& pixel) {
        Picture map = constant_map(4, glm::vec3(1.0f));
        map.pixels[8 * 2 + 5] = pixel;
        write_exr(folder / name, map);
    };
    with_pixel("nan.exr", {1.0f, std::numeric_limits<float>::quiet_NaN(), 1.0f});
    with_pixel("negative.exr", {1.0f, 1.0f, -1.0f});
    with_pixel("infinite.exr", glm::vec3(std::numeric_limits<float>::infinity()));
    with_pixel("good.exr", glm::vec3(1.0f));
    write_exr(folder / "black.exr", constant_map(4, glm::vec3(0.0f)));
    write_exr(folder / "square.exr", Picture(4, 4));
    folder.write("text.exr", "no picture");
    folder.write("text.hdr", "no picture");
    folder.write("cut.hdr", hdr(8, 4, "\x80\x80"));
    folder.write("map.png", "no picture");
    const Refusal refusals[] = {
        {"--env nan.exr", 1, "nan.exr: environment map, pixel (5, 2)"},
        {"--env negative.exr", 1, "negative.exr: environment map, pixel (5, 2)"},
        {"--env infinite.exr", 1, "infinite.exr: environment map, pixel (5, 2)"},
        {"--env black.exr", 1, "black.exr: environment map: all pixels are black"},
        {"--env square.exr", 1, "square.exr: environment map: 4 x 4 pixels"},
        {"--env text.exr", 1, "text.exr"},
        {"--env text.hdr", 1, "text.hdr"},
        {"--env cut.hdr", 1, "cut.hdr"},
        {"--env absent.hdr", 1, "absent.hdr"},
        {"--env map.png", 1, "map.png"},
        {"--env good.exr --env-lights 0", 1, "no lights"},
        {"--env good.exr --env-scale 0", 2, "--env-scale"},
        {"--env good.exr --env-rotate nan", 2, "--env-rotate"},
        {"--env good.exr --env-lights many", 2, "--env-lights"},
        {"--sun-sky 30", 2, "--sun-sky"},
        {"--sun-sky -1,0", 2, "--sun-sky"},
        {"--sun-sky 91,0", 2, "--sun-sky"},
        {"--sun-sky 30,nan", 2, "--sun-sky"},
        {"--sun-sky 30,0 --turbidity 1", 2, "--turbidity"},
        {"--turbidity 3", 2, "--sun-sky"},
        {"--sky-lights 3", 2, "--sun-sky"},
        {"--ground 0.3", 2, "--sun-sky"},
        {"--env good.exr --ground 0.3", 2, "--sun-sky"},
        {"--sun-sky 30,0 --ground 1.1", 2, "--ground"},
        {"--sun-sky 30,0 --ground -0.1", 2, "--ground"},
        {"--sun-sky 30,0 --ground nan", 2, "--ground"},
        {"--env-lights 9", 2, "--env"},
        {"--env-scale 2", 2, "--env"},
        {"--env-rotate 2", 2, "--env"},
    };
    const auto before = files();
    for (const Refusal& refusal : refusals) {
        const auto result = render("floor.obj --size 4x4 " + std::string(refusal.arguments) + view);
        EXPECT_EQ(result.status, refusal.status) << refusal.arguments << ": " << result.err;
        EXPECT_TRUE(is_one_line(result.err)) << refusal.arguments << ": " << result.err;
        EXPECT_NE(result.err.find(refusal.says), std::string::npos) << refusal.arguments << ": " << result.err;
        EXPECT_EQ(files(), before) << refusal.arguments;
    }
}

}  // namespace
