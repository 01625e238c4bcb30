#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <benchmarks/report/equal_time.hpp>

namespace {

using benchmark::Curve;
using benchmark::Effort;
using benchmark::Measurement;

TEST(EqualTime, InterpolatesPowerLawsExactly) {
    // error = 0.3 / sqrt(seconds), as of sampling
    const auto law = [](double seconds) { return 0.3 / std::sqrt(seconds); };
    const std::vector<Effort> settings = {{9.0, law(9.0)}, {1.0, law(1.0)}, {40.0, law(40.0)}};
    for (const double seconds : {1.0, 2.0, 9.0, 33.0, 40.0}) {
        EXPECT_NEAR(*benchmark::error_at(settings, seconds), law(seconds), 1e-12) << seconds;
        EXPECT_NEAR(*benchmark::time_of(settings, law(seconds) * (1 + 1e-13)), seconds, 1e-9) << seconds;
    }
}

TEST(EqualTime, DoesNotExtrapolate) {
    const std::vector<Effort> settings = {{1.0, 0.1}, {4.0, 0.05}};
    EXPECT_FALSE(benchmark::error_at(settings, 0.99));
    EXPECT_EQ(*benchmark::error_at(settings, 100.0), 0.05);
    EXPECT_FALSE(benchmark::time_of(settings, 0.049));
    EXPECT_EQ(*benchmark::time_of(settings, 0.2), 1.0);
    EXPECT_FALSE(benchmark::error_at({}, 1.0));
    EXPECT_FALSE(benchmark::time_of({}, 1.0));
}

TEST(EqualTime, LeavesOutSettingsThatAFasterOneBeats) {
    const std::vector<Effort> settings = {{1.0, 0.1}, {2.0, 0.4}, {4.0, 0.025}};
    EXPECT_NEAR(*benchmark::error_at(settings, 2.0), 0.05, 1e-12);
    EXPECT_NEAR(*benchmark::time_of(settings, 0.05), 2.0, 1e-12);
}

TEST(EqualTime, TakesWhatIsExact) {
    const std::vector<Effort> settings = {{1.0, 0.01}, {100.0, 0.0}};
    EXPECT_NEAR(*benchmark::error_at(settings, 10.0), 1e-3, 1e-12);  // on the way to the smallest error
    EXPECT_EQ(*benchmark::error_at(settings, 100.0), 0.0);
    EXPECT_NEAR(*benchmark::time_of(settings, 1e-3), 10.0, 1e-9);
    EXPECT_EQ(*benchmark::time_of({{1.0, 0.0}}, 0.02), 1.0);
}

/// A curve with the same values of all errors.
Curve curve(const benchmark::ReportMethod& method, const std::vector<Effort>& settings) {
    Curve result;
    result.method = &method;
    for (const Effort& e : settings) {
        Measurement& m = result.points.emplace_back();
        m.seconds = e.seconds;
        m.error.relative_rmse = m.error.p999_relative = m.error.p999_step = e.error;
    }
    return result;
}

TEST(EqualTime, ComparesLightcutsWithTheBestOther) {
    const benchmark::ReportMethod lightcuts = {"cuts", "lightcuts", "error ratio", nullptr, {}};
    const benchmark::ReportMethod ward = {"Ward", "ward", "threshold", nullptr, {}};
    const benchmark::ReportMethod power = {"power", "power", "samples", nullptr, {}};
    benchmark::SceneMeasurement scene;
    scene.exhaustive.seconds = 50.0;
    scene.curves = {curve(lightcuts, {{1.0, 0.08}, {4.0, 0.02}, {16.0, 0.005}}), curve(ward, {{30.0, 0.01}}),
                    curve(power, {{1.0, 0.4}, {16.0, 0.1}})};
    auto rows = benchmark::equal_times(scene);
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_TRUE(rows[0].reached);
    EXPECT_NEAR(rows[0].seconds, 4.0, 1e-9);
    EXPECT_NEAR(rows[0].relative_rmse.lightcuts, 0.02, 1e-9);
    EXPECT_NEAR(*rows[0].relative_rmse.best_other, 0.2, 1e-9);
    EXPECT_EQ(rows[0].relative_rmse.other, "power");
    EXPECT_NEAR(*rows[0].relative_rmse.ratio(), 0.1, 1e-9);

    scene.exhaustive.seconds = 3.0;  // few lights
    rows = benchmark::equal_times(scene);
    EXPECT_EQ(rows[0].relative_rmse.other, "exhaustive");
    EXPECT_TRUE(std::isinf(*rows[0].relative_rmse.ratio()));

    scene.exhaustive.seconds = 50.0;
    scene.curves[2] = curve(power, {{8.0, 0.1}});  // none is as fast
    EXPECT_FALSE(benchmark::equal_times(scene)[0].p999_relative.ratio());

    scene.curves[0] = curve(lightcuts, {{1.0, 0.08}, {9.0, 0.03}});
    rows = benchmark::equal_times(scene);
    EXPECT_FALSE(rows[0].reached);
    EXPECT_EQ(rows[0].seconds, 9.0);
    EXPECT_EQ(rows[0].relative_rmse.lightcuts, 0.03);
}

}  // namespace
