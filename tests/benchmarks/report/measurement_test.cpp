#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <benchmarks/report/measurement.hpp>
#include <benchmarks/report/pictures.hpp>
#include <render/io/picture.hpp>

#include "support/temporary_folder.hpp"

namespace {

using render::Picture;

/// A white triangle, a black lamp behind it that shines on it, and a camera that sees both before a bright gray sky.
struct SkyScene {
    TemporaryFolder folder;

    SkyScene() {
        folder.write("scene.mtl", "newmtl wall\nKd 0.5 0.5 0.5\nnewmtl lamp\nKd 0 0 0\nKe 9 9 9\n");
        folder.write("scene.obj",
                     "mtllib scene.mtl\nv -1 -1 0\nv 1 -1 0\nv 0 1 0\nv 1 -1 0.5\nv 2 -1 0.5\nv 1.5 0 0.5\n"
                     "usemtl wall\nf 1 2 3\nusemtl lamp\nf 4 5 6\n");
        folder.write("scene.json",
                     R"({"file": "scene.obj", "cameras": [{"eye": [0, 0, 6], "target": [0, 0, 0], "up": [0, 1, 0],
                         "vfov_deg": 40, "resolution": [160, 90]}]})");
        Picture sky(64, 32);
        for (glm::vec3& pixel : sky.pixels) pixel = glm::vec3(3.0f);
        write_exr(folder / "sky.exr", sky);
    }

    benchmark::ReportScene load(const std::string& options) const {
        benchmark::ReportSceneOptions chosen;
        chosen.scenes = {folder / "scene.obj" + "?" + options};
        chosen.width = 32;
        return benchmark::load_report_scenes(chosen).front();
    }
    std::string lit() const { return "area-points=4&env-lights=50&env=" + (folder / "sky.exr"); }
};

TEST(ReportMeasurement, IsOfReflectedLightAlone) {
    const SkyScene scene;
    const benchmark::SceneMeasurement measured = benchmark::measure(
        scene.load(scene.lit()), {.runs = 1, .threads = 1, .quick = true}, [](const std::string&) {});
    const Picture& reflected = measured.exhaustive.picture;
    std::size_t of_wall = 0, of_sky = 0, of_lamp = 0;
    for (std::size_t i = 0; i < reflected.size(); ++i) {
        const float emitted = measured.emitted.pixels[i].x;
        of_wall += emitted == 0.0f ? 1u : 0u;
        of_sky += std::abs(emitted - 3.0f) < 1e-3f ? 1u : 0u;
        of_lamp += emitted == 9.0f ? 1u : 0u;
        EXPECT_EQ(reflected.pixels[i].x > 0.0f, emitted == 0.0f) << i;
    }
    EXPECT_EQ(of_wall + of_sky + of_lamp, reflected.size());
    EXPECT_GT(of_wall, 10u);
    EXPECT_GT(of_sky, 10u);
    EXPECT_GT(of_lamp, 1u);
}

TEST(ReportPictures, ShowCutSizesBesideAFewLargeOnes) {
    std::vector<float> sizes(1000, 0.0f);
    EXPECT_FALSE(benchmark::white_cut_size(sizes));
    for (std::size_t i = 100; i < 1000; ++i) sizes[i] = 50.0f;
    EXPECT_FALSE(benchmark::white_cut_size(sizes));
    for (std::size_t i = 500; i < 1000; ++i) sizes[i] = 80.0f;
    for (std::size_t i = 0; i < 5; ++i) sizes[i] = 1e5f;
    EXPECT_EQ(benchmark::white_cut_size(sizes), 80.0f);
    for (std::size_t i = 0; i < 50; ++i) sizes[i] = 1e5f;
    EXPECT_EQ(benchmark::white_cut_size(sizes), 1e5f);
}

TEST(ReportScenes, AreNamedWithoutFolders) {
    const SkyScene scene;
    EXPECT_EQ(scene.load(scene.lit()).name, "scene?area-points=4&env-lights=50&env=sky.exr");
    EXPECT_EQ(scene.load("area-points=4").name, "scene?area-points=4");
}

}  // namespace
