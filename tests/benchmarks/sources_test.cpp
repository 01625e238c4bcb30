#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "benchmarks/particle_cost.hpp"
#include "benchmarks/prepared_scene.hpp"
#include "benchmarks/scene_options.hpp"
#include "benchmarks/shading_cost.hpp"
#include "benchmarks/source_scenes.hpp"
#include "program.hpp"

namespace {

struct Sources : BenchmarkProgram {
    Sources() : BenchmarkProgram(LIGHTCUTS_SOURCES_EXECUTABLE) {}
};

const std::string quick = "--width 16 --height 12 --runs 1 --error-points 5 ";

TEST_F(Sources, MeasuresAllParts) {
    const auto result = run(quick +
                            "--virtual-lights 2000 --environment builtin:directional --environment-lights 100,300 "
                            "--lamp-lights 1,4 --few builtin:omni?lights=20 --many builtin:surfaces?lights=1000");
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    std::map<std::string, std::vector<nlohmann::json>> parts;
    for (const auto& row : figures("sources.json")) {
        EXPECT_GT(row.at("microseconds"), 0.0) << row;
        EXPECT_GT(row.at("ratio"), 0.0) << row;
        EXPECT_GT(row.at("rays"), 0.0) << row;
        parts[row.at("part")].push_back(row);
    }
    ASSERT_EQ(parts["particles"].size(), 3u);
    EXPECT_NEAR(parts["particles"][1].at("lights").get<double>(), 2000.0, 200.0);
    ASSERT_EQ(parts["environment"].size(), 2u);
    EXPECT_EQ(parts["environment"][1].at("lights"), 300);
    ASSERT_EQ(parts["few"].size(), 6u);
    for (std::size_t i = 0; i < 6; i += 2) {
        EXPECT_EQ(parts["few"][i].at("relative_rmse"), nullptr);
        EXPECT_LT(parts["few"][i + 1].at("relative_rmse"), 0.05);
        EXPECT_LE(parts["few"][i + 1].at("rays"), parts["few"][i].at("rays"));
    }
    ASSERT_EQ(parts["many"].size(), 3u);
    EXPECT_EQ(parts["many"][0].at("lights"), 4608);
    EXPECT_LT(parts["many"][2].at("points"), parts["many"][1].at("points"));
}

TEST_F(Sources, MeasuresPartsAlone) {
    const auto result = run(quick + "--only few --lamp-lights 4 --few builtin:omni?lights=5");
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(figures("sources.json").size(), 4u);
}

TEST_F(Sources, HeedWhatAScenesNameSays) {
    const auto result = run(quick + "--only few --lamp-lights 1 --few builtin:hall?area-points=1&indirect=200");
    ASSERT_EQ(result.status, 0) << result.err;
    const auto rows = figures("sources.json");
    EXPECT_NEAR(rows.at(2).at("lights").get<double>(), 72.0 + 200.0, 40.0);
    EXPECT_LT(rows.at(3).at("relative_rmse"), 0.05);
}

TEST_F(Sources, RefusesWhatCannotBe) {
    const std::pair<std::string, std::string> refusals[] = {
        {"--only few --lamp-lights 4 --few builtin:none", "builtin:none"},
        {"--only few --lamp-lights 4 --few builtin:hall?env-scale=2", "builtin:hall?env-scale=2: --env-scale needs"},
        {"--only environment --environment builtin:hall?indirect=50", "builtin:hall?indirect=50: "},
        {"--only nonsense", "nonsense"},
        {"--only few --runs 2", "--runs"},
    };
    for (const auto& [arguments, says] : refusals) {
        const auto result = run((arguments.find("--runs") == std::string::npos ? quick : "") + arguments);
        EXPECT_NE(result.status, 0) << arguments;
        EXPECT_NE(result.err.find(says), std::string::npos) << arguments << ": " << result.err;
        EXPECT_FALSE(folder.has("sources.json")) << arguments;
    }
    std::filesystem::create_directory(folder / "sources.json");
    const auto result = run(quick + "--only few --few builtin:none");
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.err,
              "bench-sources: sources.json: cannot be written (not a regular file); choose another place\n");
}

TEST_F(Sources, TraceTheRaysThatWereRecordedOnLeavesToo) {
    folder.write("leaves.gltf", R"({"asset":{"version":"2.0"},"extensionsUsed":["KHR_materials_diffuse_transmission"],
        "buffers":[{"byteLength":60,"uri":"data:application/octet-stream;base64,)" +
                                    std::string("AACAvwAAAAAAAIC/AACAPwAAAAAAAIC/AACAPwAAAAAAAIA/AACAvwAAAAAAAIA/"
                                                "AAACAAEAAAADAAIA") +
                                    R"("}],
        "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
        {"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],
        "materials":[{"pbrMetallicRoughness":{"metallicFactor":0},
        "extensions":{"KHR_materials_diffuse_transmission":{"diffuseTransmissionFactor":0.75}}}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],
        "extensions":{"KHR_lights_punctual":{"lights":[{"type":"point","intensity":4}]}},
        "nodes":[{"mesh":0},{"mesh":0,"translation":[0,1,0]},
        {"translation":[0.1,0.5,0.2],"extensions":{"KHR_lights_punctual":{"light":0}}}]})");
    const auto cost = benchmark::measure_particles(
        {.scene = folder / "leaves.gltf" + "?seed=3", .lights = 3000, .area_points = 1, .threads = 1, .runs = 1});
    EXPECT_GT(cost.virtual_lights, 1000u);
    EXPECT_EQ(cost.recorded_lights, cost.virtual_lights);
}

TEST(SourceScenes, GiveALampsFluxToAnyNumberOfLights) {
    for (const std::size_t points : {1u, 16u, 64u}) {
        const render::Scene room = benchmark::room_with_lamp(points);
        ASSERT_EQ(room.oriented.size(), points);
        glm::vec3 sum(0.0f);
        for (const auto& light : room.oriented) {
            sum += light.intensity;
            EXPECT_LT(light.axis.y, -0.999f);
        }
        EXPECT_NEAR(sum.x, 12.0f, 1e-3f);  // radiance x 1 m^2
    }
}

TEST(SourceScenes, KeepTheMapThatIsThere) {
    render::Options options = benchmark::scene_options("builtin:directional?lights=10");
    render::Scene scene = benchmark::prepared_scene("sky", options);
    benchmark::surround(scene);
    scene.background.environment->picture.pixels.front() = glm::vec3(7.0f);
    benchmark::surround(scene);
    EXPECT_EQ(scene.background.environment->picture.pixels.front(), glm::vec3(7.0f));
    benchmark::light_by_map(scene, 30);
    EXPECT_EQ(scene.directional.size(), 30u);
}

TEST(ShadedPoints, HaveAClearViewUnlessSomethingIsInTheWay) {
    // A lamp above a floor, half of which a board hides from it.
    render::Scene scene;
    scene.materials.resize(1);
    const auto quad = [&](float y, float left, float right) {
        const auto first = static_cast<std::uint32_t>(scene.positions.size());
        for (const glm::vec2 at :
             {glm::vec2(left, -1), glm::vec2(right, -1), glm::vec2(right, 1), glm::vec2(left, 1)}) {
            scene.positions.emplace_back(at.x, y, at.y);
        }
        for (const glm::uvec3 t : {glm::uvec3(0, 2, 1), glm::uvec3(0, 3, 2)}) {
            scene.triangles.push_back(first + t);
            scene.triangle_material.push_back(0);
        }
    };
    quad(0.0f, -1.0f, 1.0f);
    quad(99.0f, -100.0f, 0.0f);
    scene.omni.push_back({{0.0f, 100.0f, 0.0f}, glm::vec3(1.0f), {}});
    scene.cameras.push_back({"", {0, 3, 0}, {0, 0, 0}, {0, 0, -1}, 20.0f});
    const benchmark::ShadedPoints where(scene, 8, 8);
    EXPECT_EQ(where.points().size(), 64u);
    const auto clear = where.with_clear_view();
    EXPECT_EQ(clear.size(), 32u);
    for (const auto& point : clear) EXPECT_GT(point.position.x, 0.0f);
    EXPECT_EQ(where.about(10).size(), 11u);
}

}  // namespace
