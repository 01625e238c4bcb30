#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <daylight/sensors.hpp>
#include <render/refusal.hpp>
#include "support/temporary_folder.hpp"

namespace {

using namespace daylighting;
using ::testing::HasSubstr;

TEST(Sensors, of_a_grid_fill_it_from_the_northwest) {
    const SensorSet set = sensors_of({{4.0, 0.8, 3.0}, {0.0, 0.8, 0.0}, 1.0}, UpAxis::y);
    ASSERT_EQ(set.sensors.size(), 12u);
    EXPECT_EQ(set.columns, 4u);
    EXPECT_EQ(set.rows, 3u);
    EXPECT_EQ(set.sensors[0], (Sensor{{0.5, 0.8, 0.5}, {0.0f, 1.0f, 0.0f}}));
    EXPECT_EQ(set.sensors[11], (Sensor{{3.5, 0.8, 2.5}, {0.0f, 1.0f, 0.0f}}));
    const SensorSet radiance = sensors_of({{0.0, 0.0, 0.8}, {4.0, 3.0, 0.8}, 10.0}, UpAxis::z);
    ASSERT_EQ(radiance.sensors.size(), 1u);
    EXPECT_EQ(radiance.sensors[0], (Sensor{{2.0, 1.5, 0.8}, {0.0f, 0.0f, 1.0f}}));
}

TEST(Sensors, of_a_grid_that_is_none_are_refused) {
    EXPECT_THAT(refusal([] { sensors_of({{0, 0, 0}, {1, 1, 1}, 0.5}, UpAxis::y); }), HasSubstr("differ in y"));
    EXPECT_THAT(refusal([] { sensors_of({{0, 0, 0}, {1, 0, 0}, 0.5}, UpAxis::y); }), HasSubstr("not apart"));
    EXPECT_THAT(refusal([] { sensors_of({{0, 0, 0}, {1e6, 0, 1e6}, 0.5}, UpAxis::y); }), HasSubstr("--spacing"));
}

TEST(Sensors, are_read_as_radiance_writes_them) {
    TemporaryFolder folder;
    const std::string path = folder.write("a.pts", "# a comment\r\n1 2 3 0 0 2\r\n\n\t-1.5e1 +2 3   1 0 0\n");
    const SensorSet set = read_sensors(path, UpAxis::z);
    ASSERT_EQ(set.sensors.size(), 2u);
    EXPECT_EQ(set.columns, 0u);
    EXPECT_EQ(set.sensors[0], (Sensor{{1, 2, 3}, {0, 0, 1}}));
    EXPECT_EQ(set.sensors[1], (Sensor{{-15, 2, 3}, {1, 0, 0}}));
}

TEST(Sensors, that_are_none_are_refused_with_their_line) {
    TemporaryFolder folder;
    const auto refused = [&](const std::string& text) {
        const std::string path = folder.write("a.pts", text);
        return refusal([&] { read_sensors(path, UpAxis::z); });
    };
    EXPECT_THAT(refused("0 0 0 0 0 1\n0 0 0 0 0\n"), HasSubstr("a.pts:2: 5 numbers; a sensor has 6"));
    EXPECT_THAT(refused("0 0 0 0 0 nan\n"), HasSubstr("a.pts:1: 'nan' is not a finite number"));
    EXPECT_THAT(refused("0 0 0 0 0 0\n"), HasSubstr("a.pts:1: the direction dx dy dz has zero length"));
    EXPECT_THAT(refused("0 0 x 0 0 1\n"), HasSubstr("a.pts:1: 'x'"));
    EXPECT_THAT(refused("# nothing\n"), HasSubstr("no sensors"));
    EXPECT_THAT(refusal([&] { read_sensors(folder / "absent", UpAxis::z); }), HasSubstr("no such file"));
}

}  // namespace
