#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "benchmarks/crossing.hpp"
#include "benchmarks/cut_parts.hpp"
#include "benchmarks/method_contest.hpp"
#include "program.hpp"

namespace {

using nlohmann::json;

struct PaperTables : BenchmarkProgram {
    PaperTables() : BenchmarkProgram(LIGHTCUTS_PAPER_TABLES_EXECUTABLE) {}

    Process::Result measure(const std::string& arguments) {
        return run("--width 18 --height 12 --runs 1 --points 20 " + arguments);
    }
    json tables() const { return figures("paper_tables.json"); }
};

TEST_F(PaperTables, HaveARowForAllThatIsAsked) {
    const auto result = measure(
        "--cuts builtin:hall?area-points=4&indirect=300 builtin:directional?lights=200 "
        "--hall-points 1,4 --map-lights 20,50 --bounds builtin:omni?lights=300 "
        "--speed-up builtin:omni?lights=300 --thresholds builtin:omni?lights=300 "
        "--error-ratios 0.5,0 --representatives 1,4");
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err, "");
    const json all = tables();

    ASSERT_EQ(all.at("cuts").size(), 2u);
    for (const json& row : all.at("cuts")) {
        EXPECT_LE(row.at("cut_size").at("total"), row.at("lights").at("total")) << row;
        EXPECT_LE(row.at("rays"), row.at("cut_size").at("total")) << row;
        EXPECT_LE(row.at("naive_rays"), row.at("lights").at("total")) << row;
        EXPECT_LE(row.at("ward_rays"), row.at("naive_rays")) << row;
        EXPECT_GT(row.at("naive_over_lightcuts"), 0.0) << row;
        EXPECT_LT(row.at("relative_rmse"), 0.1) << row;
    }
    EXPECT_EQ(all.at("cuts")[0].at("lights").at("direct"), 288);
    EXPECT_EQ(all.at("cuts")[1].at("lights").at("environment"), 200);

    ASSERT_EQ(all.at("scaling").size(), 2u);
    for (const json& scene : all.at("scaling")) EXPECT_EQ(scene.at("rows").size(), 2u);
    EXPECT_EQ(all.at("scaling")[0].at("rows")[1].at("lights"), 288);
    EXPECT_EQ(all.at("scaling")[1].at("rows")[1].at("lights"), 50);

    ASSERT_EQ(all.at("bounds").size(), 1u);
    // No valid bound can do better, but for what the order of rounds does.
    EXPECT_GE(all.at("bounds")[0].at("over_exact"), 0.99);

    ASSERT_EQ(all.at("speed-up").size(), 1u);
    EXPECT_GT(all.at("speed-up")[0].at("agglomerate_seconds"), 0.0);

    ASSERT_EQ(all.at("thresholds").size(), 1u);
    const json& rows = all.at("thresholds")[0].at("rows");
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[1].at("representatives"), 4);
    EXPECT_GT(rows[0].at("relative_rmse"), 1e-3);
    EXPECT_LT(rows[2].at("relative_rmse"), 1e-5);  // at a threshold of zero the cut is the sum
    EXPECT_GT(rows[2].at("cut_size"), rows[0].at("cut_size"));
}

TEST_F(PaperTables, AreMeasuredAlone) {
    const auto result = measure("--only bounds --bounds builtin:omni?lights=50");
    ASSERT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(tables().size(), 1u);
}

TEST_F(PaperTables, RefuseWhatIsNoScene) {
    const auto result = measure("--only cuts --cuts builtin:none");
    EXPECT_EQ(result.status, 1);
    EXPECT_NE(result.err.find("builtin:none"), std::string::npos) << result.err;
    EXPECT_FALSE(folder.has("paper_tables.json"));
}

TEST(CutParts, AreCountedByKind) {
    const benchmark::Workload room("builtin:hall?area-points=4&indirect=300", 12, 9);
    const benchmark::CutParts mixed = benchmark::measure_cut_parts(room, {.clamp = room.clamp()});
    EXPECT_EQ(mixed.lights.direct, 288.0);
    EXPECT_GT(mixed.lights.indirect, 200.0);
    EXPECT_EQ(mixed.lights.sum(), static_cast<double>(room.light_count()));
    EXPECT_GT(mixed.cut.direct, 1.0);
    EXPECT_GT(mixed.cut.indirect, 1.0);
    EXPECT_EQ(mixed.cut.environment, 0.0);

    const benchmark::Workload field("builtin:directional?lights=200", 12, 9);
    const benchmark::CutParts sky = benchmark::measure_cut_parts(field, {.max_cut = 7});
    EXPECT_NEAR(sky.cut.environment, 7.0, 1e-9);
    EXPECT_EQ(sky.cut.sum(), sky.cut.environment);
    EXPECT_NEAR(sky.at_limit, 1.0, 1e-9);
}

TEST(MethodContest, ComparesEachMethodWithTheSumThatItApproximates) {
    const benchmark::Workload room("builtin:hall?area-points=1&indirect=100", 12, 9);
    benchmark::MethodContest contest(room, 30);
    const auto exact = contest.add([](render::Options& options) {
        options.method = "lightcuts";
        options.error_ratio = 0.0f;
    });
    const auto ward = contest.add([](render::Options& options) {
        options.method = "ward";
        options.ward_threshold = 0.0f;
    });
    contest.run(1);
    EXPECT_LT(contest.error(exact), 1e-4);
    EXPECT_LT(contest.error(ward), 1e-4);  // does not clamp; clamping takes more than this
    EXPECT_GT(benchmark::relative_rmse(contest.shadings(ward), contest.shadings(exact)), 1e-3);
}

TEST(Crossing, LiesBetweenNeighborsOnLogarithmicScales) {
    EXPECT_NEAR(benchmark::crossing({1, 100}, {0.1, 10}), 10.0, 1e-9);
    EXPECT_NEAR(benchmark::crossing({1, 2, 8}, {0.5, 0.5, 4}), 2.0 * std::pow(4.0, 1.0 / 3.0), 1e-9);
    EXPECT_EQ(benchmark::crossing({1, 100}, {2, 10}), 0.0);
    EXPECT_EQ(benchmark::crossing({1, 100}, {0.1, 0.9}), 0.0);
}

}  // namespace
