#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "benchmarks/shading_cost.hpp"
#include "benchmarks/source_scenes.hpp"
#include "render/process.hpp"
#include "render/temporary_folder.hpp"

namespace {

struct Sources : testing::Test {
    TemporaryFolder folder;
    TemporaryFolder streams;

    Process::Result run(const std::string& arguments) {
        std::vector<std::string> words;
        std::istringstream text(arguments);
        for (std::string word; text >> word;) words.push_back(word);
        return Process(LIGHTCUTS_SOURCES_EXECUTABLE, words, folder.path(), streams.path()).wait();
    }
};

const std::string quick = "--width 16 --height 12 --runs 1 --error-points 5 ";

TEST_F(Sources, MeasuresAllParts) {
    const auto result = run(quick +
                            "--virtual-lights 2000 --environment builtin:directional --environment-lights 100,300 "
                            "--lamp-lights 1,4 --few builtin:omni?lights=20 --many builtin:surfaces?lights=1000");
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    std::map<std::string, std::vector<nlohmann::json>> parts;
    for (const auto& row : nlohmann::json::parse(folder.read("sources.json"))) {
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
    EXPECT_EQ(nlohmann::json::parse(folder.read("sources.json")).size(), 4u);
}

TEST_F(Sources, RefusesWhatIsNoScene) {
    const auto result = run(quick + "--only few --lamp-lights 4 --few builtin:none");
    EXPECT_EQ(result.status, 1);
    EXPECT_NE(result.err.find("builtin:none"), std::string::npos) << result.err;
    EXPECT_FALSE(folder.has("sources.json"));
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
    render::Scene scene = benchmark::scene_with_lights("builtin:directional?lights=10", 1);
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
