#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <string>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <render/io/picture.hpp>

#include "programs.hpp"

namespace {

using Json = nlohmann::json;
using render::Picture;

/// The mean of a channel.
double mean_of(const Picture& picture, int channel = 0) {
    double sum = 0.0;
    for (const glm::vec3& p : picture.pixels) sum += static_cast<double>(p[channel]);
    return sum / static_cast<double>(picture.pixels.size());
}

TEST_F(Programs, MultidimensionalPicturesAgreeWithTheSumOverAllPairs) {
    const std::string scene = "room.obj --area-points 300 --size 40x30 --spp 9 --quiet" + view;
    for (const std::string effect :
         {"", " --aperture 0.4", " --fog 0.15 --fog-anisotropy 0.5", " --aperture 0.4 --fog 0.15 --filter gaussian"}) {
        // One picture's error is one draw of its representatives.
        constexpr int seeds = 4;
        std::map<std::string, double> squares;
        for (int seed = 1; seed <= seeds; ++seed) {
            const std::string picture = scene + effect + " --seed " + std::to_string(seed);
            ASSERT_EQ(render(picture + " --method exhaustive -o exact.exr").status, 0);
            for (const std::string method : {"multidimensional", "unified-cut"}) {
                ASSERT_EQ(render(picture + " --reference exact.exr --method " + method).status, 0);
                const Json json = report("render.json");
                const double error = json.at("error").at("relative_rmse");
                EXPECT_GT(error, 0.0) << method << effect;
                EXPECT_EQ(json.at("method"), method);
                squares[method] += error * error / seeds;
            }
        }
        EXPECT_LT(std::sqrt(squares["multidimensional"]), 0.025) << effect;
        // Its pairs are of single points, of whose clusters of lights more are left as they are.
        EXPECT_LT(std::sqrt(squares["unified-cut"]), 0.035) << effect;
    }
}

TEST_F(Programs, MultidimensionalPicturesOfLitFogAgreeWithTheSumOverAllPairs) {
    const std::string scene =
        "room.obj --size 40x30 --spp 9 --fog 0.15 --fog-anisotropy 0.5 --indirect 3000 "
        "--clamp off --quiet" +
        view;
    ASSERT_EQ(render(scene + " --method exhaustive -o exact.exr").status, 0);
    ASSERT_EQ(render(scene + " --reference exact.exr --method multidimensional").status, 0);
    const Json json = report("render.json");
    EXPECT_LT(json.at("error").at("relative_rmse"), 0.025);
    EXPECT_GT(json.at("lights").at("virtual"), 2000);
}

TEST_F(Programs, MultidimensionalPicturesOfMovingLightsInFogAgreeWithTheSumOverAllPairs) {
    const std::string scene =
        "builtin:night?lights=6 --size 12x9 --spp 8 --fog 0.05 --shutter 0.25 --instants 8 "
        "--area-points 1 --indirect 400 --env-lights 40 --clamp off --quiet "
        "--method multidimensional --aov instants";
    ASSERT_EQ(render(scene + " --error-ratio 0 --max-cut 0 -o exact.exr").status, 0);
    ASSERT_EQ(render(scene + " --reference exact.exr").status, 0);
    const Json json = report("render.json");
    EXPECT_LT(json.at("error").at("relative_rmse"), 0.025);
    EXPECT_EQ(json.at("motion").at("lights"), 48);
    EXPECT_GT(json.at("lights").at("virtual"), 200);
    float most = 0.0f;
    const Picture found = render::read_exr(folder / "render.exr");
    for (const float instants : found.find("instants")->values) {
        EXPECT_GE(instants, 1.0f);
        EXPECT_LE(instants, 8.0f);
        most = std::max(most, instants);
    }
    EXPECT_GT(most, 1.5f);
    // Finer clusters have fewer instants each.
    const auto sum = [](const Picture& picture) {
        const auto& values = picture.find("instants")->values;
        return std::accumulate(values.begin(), values.end(), 0.0);
    };
    EXPECT_LT(sum(render::read_exr(folder / "exact.exr")), sum(found));
}

/// The largest share of a pixel of `free` that `clamped`, which is nowhere brighter, lacks.
float largest_loss(const Picture& free, const Picture& clamped) {
    float loss = 0.0f;
    for (std::size_t i = 0; i < free.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            EXPECT_LE(clamped.pixels[i][c], 1.0001f * free.pixels[i][c]) << i;
            if (free.pixels[i][c] > 0.0f) loss = std::max(loss, 1.0f - clamped.pixels[i][c] / free.pixels[i][c]);
        }
    }
    return loss;
}

/// By a share of a pixel's total; of one point a pixel that is what other methods clamp.
TEST_F(Programs, MultidimensionalPicturesMayBeClampedByShare) {
    const std::string scene = "room.obj --size 24x18 --indirect 3000 --materials diffuse --quiet" + view;
    const auto picture = [&](const std::string& arguments) {
        EXPECT_EQ(render(scene + arguments + " -o picture.exr").status, 0) << arguments;
        return render::read_exr(folder / "picture.exr");
    };
    EXPECT_GT(
        largest_loss(picture(" --method exhaustive --clamp off"), picture(" --method exhaustive --clamp-ratio 0.001")),
        0.1f)
        << "nothing to clamp";
    for (const std::string method : {"multidimensional", "unified-cut"}) {
        ASSERT_EQ(render(scene + " --clamp-ratio 0.001 --reference picture.exr --method " + method).status, 0);
        EXPECT_LT(report("render.json").at("error").at("relative_rmse"), 0.025) << method;
    }

    const std::string pixels = " --spp 9 --method multidimensional", exact = pixels + " --error-ratio 0 --max-cut 0";
    const Picture free = picture(exact + " --clamp off");
    EXPECT_EQ(picture(exact).pixels, free.pixels) << "nothing is clamped without the eye's adaptation";
    EXPECT_EQ(report("picture.json").at("clamp").at("mode"), "off");
    EXPECT_GT(largest_loss(free, picture(exact + " --clamp-ratio 0.001")), 0.05f);
    const Json json = report("picture.json"), clamp = json.at("clamp"), threshold = clamp.at("threshold");
    EXPECT_EQ(json.at("options").at("clamp"), "auto");
    EXPECT_EQ(clamp.at("mode"), "auto");
    EXPECT_NEAR(clamp.at("ratio"), 0.001, 1e-9);
    EXPECT_GT(threshold.at("min"), 0.0);
    EXPECT_LE(threshold.at("min"), threshold.at("mean"));
    EXPECT_LE(threshold.at("mean"), threshold.at("max"));
    // A cut that is exact is the reference of a pixel.
    ASSERT_EQ(render(scene + pixels + " --clamp-ratio 0.001 --reference picture.exr").status, 0);
    EXPECT_LT(report("render.json").at("error").at("relative_rmse"), 0.025);
}

TEST_F(Programs, MultidimensionalErrorsAreWithinTheirBounds) {
    const std::string scene = "room.obj --area-points 300 --size 24x18 --spp 4 --quiet --error-ratio 0.1" + view;
    ASSERT_EQ(render(scene + " --method exhaustive -o exact.exr").status, 0);
    ASSERT_EQ(render(scene + " --method multidimensional --max-cut 0 --aov error_bound").status, 0);
    const Picture exact = render::read_exr(folder / "exact.exr"), found = render::read_exr(folder / "render.exr");
    const std::string channels = "RGB";
    for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const float bound = found.find("error_bound." + channels.substr(static_cast<std::size_t>(c), 1))->values[i];
            EXPECT_LE(std::abs(found.pixels[i][c] - exact.pixels[i][c]), bound + 1e-4f * exact.pixels[i][c]) << i;
        }
    }
}

TEST_F(Programs, ShowHowManyGatherPointsAndPairsThereAre) {
    const std::string scene = "room.obj --area-points 300 --size 16x12 --spp 4 --quiet --aov gather_points,instants" +
                              view;
    for (const std::string method : {"lightcuts", "multidimensional"}) {
        ASSERT_EQ(render(scene + " --method " + method).status, 0);
        const Picture picture = render::read_exr(folder / "render.exr");
        const Json json = report("render.json");
        double sum = 0.0;
        for (const float count : picture.find("gather_points")->values) sum += static_cast<double>(count);
        const double each = sum / (16.0 * 12.0);
        EXPECT_NEAR(json.at("gather_points_per_pixel"), each, 1e-6);
        EXPECT_LE(each, 4.0);
        EXPECT_GT(each, 2.0) << "one of a ray, where there is something to see";
        const auto& counts = picture.find("gather_points")->values;
        for (std::size_t i = 0; i < counts.size(); ++i) {
            EXPECT_EQ(picture.find("instants")->values[i], counts[i] > 0.0f ? 1.0f : 0.0f);
        }
        if (method == "lightcuts") {
            EXPECT_TRUE(json.at("pairs_per_pixel").is_null());
        } else {
            const double lights = json.at("lights").at("oriented");
            EXPECT_NEAR(json.at("pairs_per_pixel"), each * lights, 1e-6 * each * lights);
        }
    }
}

TEST_F(Programs, MultidimensionalPicturesDoNotDependOnThreads) {
    const std::string scene =
        "room.obj --area-points 300 --size 40x30 --spp 5 --fog 0.1 --aperture 0.1 --quiet "
        "--method multidimensional" +
        view;
    ASSERT_EQ(render(scene + " --threads 1 -o one.exr").status, 0);
    ASSERT_EQ(render(scene + " --threads 4 -o four.exr").status, 0);
    EXPECT_EQ(render::read_exr(folder / "one.exr").pixels, render::read_exr(folder / "four.exr").pixels);
}

TEST_F(Programs, AnApertureOfZeroAndNoFogAreTheSamePicture) {
    for (const std::string method : {"lightcuts", "multidimensional"}) {
        const std::string scene = "room.obj --size 24x18 --spp 3 --quiet --method " + method + view;
        ASSERT_EQ(render(scene + " -o plain.exr").status, 0);
        ASSERT_EQ(render(scene + " --aperture 0 --fog 0 --fog-albedo 0.2 --filter box").status, 0);
        EXPECT_EQ(render::read_exr(folder / "plain.exr").pixels, render::read_exr(folder / "render.exr").pixels);
    }
}

TEST_F(Programs, FogAttenuatesWhatIsSeenAndScattersWhatItIsLitBy) {
    // Straight down on a place of the floor 2.9 below, to which the light comes from about 4 away.
    const std::string above = " --eye 2,2.9,2 --target 2,0,2 --up 0,0,-1 --fov 1 --size 1x1 --spp 64 --quiet ";
    ASSERT_EQ(render("room.obj --lights one.csv --method exhaustive --area-points 0 -o clear.exr" + above).status, 0);
    ASSERT_EQ(
        render("room.obj --lights one.csv --method exhaustive --area-points 0 --fog 0.2 --fog-albedo 0 -o dim.exr" +
               above)
            .status,
        0);
    const double clear = mean_of(render::read_exr(folder / "clear.exr"));
    const double dim = mean_of(render::read_exr(folder / "dim.exr"));
    const double light_way = glm::distance(glm::dvec3(0.5, 2.0, -0.25), glm::dvec3(2.0, 0.0, 2.0));
    EXPECT_NEAR(dim / (clear * std::exp(-0.2 * (2.9 + light_way))), 1.0, 0.01);
    ASSERT_EQ(
        render("room.obj --lights one.csv --method exhaustive --area-points 0 --fog 0.2 --fog-albedo 1 -o lit.exr" +
               above)
            .status,
        0);
    EXPECT_GT(mean_of(render::read_exr(folder / "lit.exr")), dim);
}

TEST_F(Programs, SidesOfPairsMayBeChosenBySize) {
    const std::string scene = "room.obj --area-points 300 --size 24x18 --spp 9 --quiet" + view;
    ASSERT_EQ(render(scene + " --method exhaustive -o exact.exr").status, 0);
    ASSERT_EQ(render(scene + " --method multidimensional").status, 0);
    const Json by_bounds = report("render.json");
    ASSERT_EQ(render(scene + " --method multidimensional --pair-sides sizes --reference exact.exr").status, 0);
    const Json by_sizes = report("render.json");
    EXPECT_NE(by_sizes.at("cut_size"), by_bounds.at("cut_size"));
    EXPECT_EQ(by_sizes.at("options").at("pair_sides"), "sizes");
    EXPECT_LT(by_sizes.at("error").at("relative_rmse"), 0.025);
    EXPECT_EQ(render("room.obj --pair-sides halves" + view).status, 2);
}

TEST_F(Programs, RefuseWhatALensCannotBe) {
    EXPECT_EQ(render("room.obj --focus 3" + view).status, 2);
    EXPECT_EQ(render("room.obj --aperture -1" + view).status, 2);
    EXPECT_EQ(render("room.obj --fog-albedo 1.5" + view).status, 2);
    EXPECT_EQ(render("room.obj --fog-anisotropy 1" + view).status, 2);
    EXPECT_EQ(render("room.obj --filter sharp" + view).status, 2);
}

}  // namespace
