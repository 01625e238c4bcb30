#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <render/io/load_scene.hpp>
#include <render/lights/emitters.hpp>
#include <render/lights/surroundings.hpp>
#include <render/scenes/studio_map.hpp>
#include <render/surfaces/texture.hpp>
#include <render/triangle.hpp>

#include "render/programs.hpp"

namespace {

using render::load_scene;
using render::Options;
using render::Scene;

template <class L>
glm::dvec3 total_intensity(const std::vector<L>& lights) {
    glm::dvec3 sum(0.0);
    for (const L& light : lights) sum += glm::dvec3(light.intensity);
    return sum;
}

Scene lit(const std::string& name, Options& options) {
    Scene scene = load_scene("builtin:" + name);
    render::add_surroundings(scene, options);
    return scene;
}

TEST(StudioMap, IsALatitudeLongitudeMapOfHighDynamicRange) {
    const render::Picture map = render::studio_map();
    ASSERT_EQ(map.width, 2 * map.height);
    std::vector<float> green;
    for (const glm::vec3& pixel : map.pixels) {
        for (int c = 0; c < 3; ++c) {
            ASSERT_TRUE(std::isfinite(pixel[c]));
            ASSERT_GT(pixel[c], 0.0f);
        }
        green.push_back(pixel.g);
    }
    std::sort(green.begin(), green.end());
    EXPECT_GT(green.back() / green[green.size() / 2], 1e4f);
    EXPECT_EQ(render::studio_map().pixels, map.pixels);
}

TEST(Tableau, IsLitByItsMapAsByAFile) {
    const render::Picture map = render::studio_map();
    glm::dvec3 power(0.0);
    for (int y = 0; y < map.height; ++y) {
        const auto edge = [&](int row) { return std::cos(std::numbers::pi * row / map.height); };
        const double solid_angle = 2.0 * std::numbers::pi / map.width * (edge(y) - edge(y + 1));
        for (int x = 0; x < map.width; ++x) {
            power += glm::dvec3(map.pixels[static_cast<std::size_t>(y * map.width + x)]) * solid_angle;
        }
    }
    for (const std::uint32_t count : {1u, 64u, 3000u}) {
        Options options;
        options.env_lights = count;
        options.env_scale = count == 64 ? 2.5f : 1.0f;
        options.given = {"--env-lights", "--env-scale"};
        const Scene s = lit("tableau", options);
        EXPECT_EQ(s.environment_lights, count);
        EXPECT_EQ(s.directional.size(), count);
        EXPECT_TRUE(s.background.environment.has_value());
        const glm::dvec3 total = total_intensity(s.directional) / static_cast<double>(options.env_scale);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(total[c] / power[c], 1.0, 1e-5) << count;
    }
}

TEST(Tableau, GivesWayToWhatTheUserPutsAround) {
    Options options;
    options.sun_sky = lightcuts::SunPosition{20.0, 10.0};
    const Scene s = lit("tableau", options);
    EXPECT_EQ(s.environment_lights, 0u);
    EXPECT_FALSE(s.background.environment.has_value());
    EXPECT_EQ(s.sun_lights, 64u);
}

TEST(Colonnade, StandsInSunAndSkyAndAsksForIndirectLight) {
    Options options;
    const Scene s = lit("colonnade", options);
    ASSERT_TRUE(options.sun_sky.has_value());
    EXPECT_EQ(s.sun_lights, 64u);
    EXPECT_EQ(s.sky_lights, 5000u);
    EXPECT_EQ(s.ground_lights, 0u) << "it has ground of its own";
    EXPECT_EQ(options.ground, 0.0f);
    EXPECT_EQ(options.indirect, 20'000u);
    EXPECT_EQ(options.clamp.radiance, 0.5f);
    EXPECT_FALSE(options.clamp.is_automatic());
    const lightcuts::SunSky daylight(
        {options.sun_sky->elevation, options.sun_sky->azimuth, static_cast<double>(options.turbidity)});
    ASSERT_TRUE(s.background.daylight.has_value());
    EXPECT_EQ(s.background.daylight->towards_sun(), daylight.towards_sun());
    const std::vector sun(s.directional.begin(), s.directional.begin() + 64);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(total_intensity(sun)[c] / static_cast<double>(daylight.sun_irradiance()[c]), 1.0, 1e-5);
    }
}

TEST(Colonnade, IsLitAsTheUserSays) {
    Options options;
    options.turbidity = 7.0f;
    options.sky_lights = 100;
    options.indirect = 0;
    options.ground = 0.3f;
    options.given = {"--turbidity", "--sky-lights", "--ground", "--indirect", "--clamp"};
    const Scene hazy = lit("colonnade", options);
    EXPECT_GT(hazy.ground_lights, 0u);
    EXPECT_EQ(options.ground, 0.3f);
    EXPECT_TRUE(options.clamp.is_automatic());
    EXPECT_EQ(hazy.sky_lights, 100u);
    EXPECT_EQ(options.turbidity, 7.0f);
    EXPECT_EQ(options.indirect, 0u);

    Options evening;
    evening.sun_sky = lightcuts::SunPosition{5.0, 270.0};
    const Scene low = lit("colonnade", evening);
    EXPECT_EQ(evening.sun_sky->elevation, 5.0);
    EXPECT_NEAR(low.background.daylight->towards_sun().y, std::sin(5.0 * std::numbers::pi / 180.0), 1e-6);
    EXPECT_EQ(low.sun_lights, 64u);
    EXPECT_EQ(evening.indirect, 20'000u);
}

TEST(Night, HasAsManyLightsAsThePapersTemple) {
    Options options;
    const Scene s = lit("night", options);
    EXPECT_EQ(s.environment_lights, 3000u);
    EXPECT_EQ(options.indirect, 50'000u);
}

TEST(Haze, IsLitBySunSkyAndWhatTheyLight) {
    Options options;
    const Scene s = lit("haze", options);
    EXPECT_EQ(s.sun_lights, 64u);
    EXPECT_EQ(s.sky_lights, 5000u);
    EXPECT_EQ(options.indirect, 50'000u);
}

TEST(Screens, EveryPixelIsALight) {
    Scene s = load_scene("builtin:screens");
    ASSERT_EQ(s.textures.size(), 2u);
    ASSERT_EQ(s.oriented.size(), 2u * 640u * 480u);
    std::size_t first = 0;
    for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
        const render::Material& material = s.materials[s.triangle_material[t]];
        if (!material.only_seen) continue;
        const glm::uvec3 corner = s.triangles[t];
        const double area = 2.0 * render::Triangle(s, t).area();  // of the screen, which is two triangles
        const glm::vec3 u = s.positions[corner.y] - s.positions[corner.x];
        const glm::vec3 v = s.positions[corner.z] - s.positions[corner.x];
        const glm::vec3 normal = glm::normalize(glm::cross(u, v));
        const render::Texture& picture = s.textures[static_cast<std::size_t>(material.emission_texture.texture)];
        ASSERT_EQ(picture.texels.size(), 640u * 480u);

        glm::dvec3 expected(0.0);
        for (const glm::vec4& texel : picture.texels) expected += glm::dvec3(texel) * glm::dvec3(material.emission);
        expected *= area / static_cast<double>(picture.texels.size());
        const std::vector of_screen(s.oriented.begin() + static_cast<std::ptrdiff_t>(first),
                                    s.oriented.begin() + static_cast<std::ptrdiff_t>(first + 640 * 480));
        const glm::dvec3 total = total_intensity(of_screen);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(total[c] / expected[c], 1.0, 1e-5);

        for (std::size_t i = 0; i < of_screen.size(); i += 997) {
            const auto& light = of_screen[i];
            EXPECT_NEAR(glm::distance(light.axis, normal), 0.0f, 1e-5f);
            // The texture, looked up as the camera would, has the light's radiance there.
            const glm::vec3 inside = glm::inverse(glm::mat3(u, v, normal)) * (light.position - s.positions[corner.x]);
            EXPECT_GT(inside.z, 0.0f);
            EXPECT_LT(inside.z, 1e-3f);
            const glm::vec2 uv = s.uv_sets[0][corner.x] + inside.x * (s.uv_sets[0][corner.y] - s.uv_sets[0][corner.x]) +
                                 inside.y * (s.uv_sets[0][corner.z] - s.uv_sets[0][corner.x]);
            const glm::vec3 seen(picture.sample(uv));
            const glm::vec3 radiance = light.intensity * static_cast<float>(640.0 * 480.0 / area);
            EXPECT_NEAR(glm::distance(seen, radiance), 0.0f, 0.02f * (1.0f + glm::length(radiance))) << i;
        }
        first += 640 * 480;
        ++t;  // the screen's other triangle
    }
    EXPECT_EQ(first, s.oriented.size());

    // What is only seen is no emissive surface: there are the two panels alone.
    EXPECT_EQ(render::emissive_surfaces(s).size(), 2u);
    render::add_emitter_lights(s, {.points = 64});
    EXPECT_EQ(s.oriented.size(), 614'400u + 2u * 64u);
}

TEST(Classroom, IsLitBySunSkyAndWhatTheyLight) {
    Options options;
    const Scene s = lit("classroom", options);
    EXPECT_EQ(s.sun_lights, 64u);
    EXPECT_EQ(s.sky_lights, 5000u);
    EXPECT_EQ(options.indirect, 20'000u);

    Options noon;
    noon.sun_sky = lightcuts::SunPosition{60.0, 90.0};
    EXPECT_NEAR(lit("classroom", noon).background.daylight->towards_sun().y, std::sin(std::numbers::pi / 3.0), 1e-6);
}

class BuiltinPictures : public Programs {};

TEST_F(BuiltinPictures, AreNeitherBlackNorNotANumber) {
    for (const std::string& name : render::builtin_names()) {
        const std::string less = name == "colonnade"   ? " --sky-lights 500 --indirect 300 --clamp off"
                                 : name == "classroom" ? " --sky-lights 500 --indirect 300"
                                 : name == "haze"      ? " --sky-lights 500 --indirect 300"
                                 : name == "night"     ? " --area-points 1 --indirect 300"
                                                       : "";
        const auto result = render("builtin:" + name + " --quiet --size 12x9 --error-ratio 0.1" + less);
        ASSERT_EQ(result.status, 0) << name << ": " << result.err;
        const render::Picture picture = render::read_exr(folder / "render.exr");
        std::size_t lit_pixels = 0;
        for (const glm::vec3& pixel : picture.pixels) {
            for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(pixel[c])) << name;
            lit_pixels += pixel.g > 0.0f ? 1 : 0;
        }
        EXPECT_GT(lit_pixels, name == "test-card" ? picture.size() / 4 : picture.size() / 2) << name;
        if (name == "screens") { EXPECT_EQ(report("render.json").at("lights").at("oriented"), 614'528); }
    }
}

TEST_F(BuiltinPictures, SayHowTheyAreLit) {
    ASSERT_EQ(render("builtin:colonnade --quiet --size 2x2 --sky-lights 50 --indirect 0").status, 0);
    EXPECT_TRUE(report("render.json").at("options").at("sun_sky").is_array());
    EXPECT_EQ(report("render.json").at("lights").at("sky"), 50);
    write_exr(folder / "gray.exr", [] {
        render::Picture map(8, 4);
        map.pixels.assign(map.size(), glm::vec3(0.5f));
        return map;
    }());
    ASSERT_EQ(
        render("builtin:tableau --quiet --size 2x2 --env gray.exr --env-lights 9 --eye 0,2,0 --target 0,9,0.1").status,
        0);
    EXPECT_EQ(report("render.json").at("lights").at("environment"), 9);
    for (const glm::vec3& pixel : render::read_exr(folder / "render.exr").pixels) EXPECT_EQ(pixel, glm::vec3(0.5f));

    for (const auto& [arguments, needed] : {std::pair{"builtin:colonnade --env-scale 2", "--env"},
                                            std::pair{"builtin:tableau --sky-lights 2", "--sun-sky"},
                                            std::pair{"builtin:tableau --sun-sky 30,0 --env-rotate 9", "--env"}}) {
        const auto refused = render(arguments);
        EXPECT_EQ(refused.status, 2) << arguments;
        EXPECT_THAT(refused.err, testing::HasSubstr(needed));
    }
}

}  // namespace
