#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/task_arena.h>

#include <daylight/bounce.hpp>
#include <daylight/trace.hpp>
#include <daylight/visibility_file.hpp>
#include "support/temporary_folder.hpp"

#include "daylight/rooms.hpp"

namespace {

using namespace daylighting;

Bounce bounce_in(Room& room, const std::vector<Sensor>& sensors, double spacing = 0.5, int threads = 2) {
    const render::RayScene rays(room.scene());
    tbb::task_arena arena(threads);
    return arena.execute([&] { return find_bounce(room.scene(), rays, sensors, {.spacing = spacing}); });
}

double share_of(const Bounce& bounce, std::size_t sensor) {
    double sum = 0.0;
    for (const Bounce::Link& link : bounce.of(sensor)) sum += static_cast<double>(link.share);
    return sum;
}

TEST(Bounce, is_that_of_the_ground_to_what_looks_down) {
    Room field = open_field();
    field.scene().materials[0].base_color = glm::vec3(0.2f, 0.3f, 0.4f);
    const std::vector<Sensor> sensors = {{{0, 0, 0}, {0, -1, 0}}, {{0, 0, 0}, {0, 1, 0}}, {{0, 0, 0}, {1, 0, 0}}};
    const Bounce bounce = bounce_in(field, sensors);
    EXPECT_NEAR(share_of(bounce, 0), 0.3, 1e-5);
    EXPECT_EQ(share_of(bounce, 1), 0.0);
    EXPECT_NEAR(share_of(bounce, 2), 0.15, 0.004);
    for (const Sensor& point : bounce.points) {
        EXPECT_EQ(point.normal, glm::vec3(0, 1, 0));
        EXPECT_NEAR(point.position.y, -1.0, 0.01);
    }
    // So what the ground gets, three tenths come back.
    Illuminances lux{3 + bounce.points.size(), 2, std::vector<float>(2 * (3 + bounce.points.size()), 0.0f)};
    for (std::size_t p = 0; p < bounce.points.size(); ++p) {
        lux.of(3 + p)[0] = 1000.0f;
        lux.of(3 + p)[1] = 10.0f;
    }
    lux.of(0)[1] = 5.0f;
    add_bounce(bounce, lux);
    lux.drop_beyond(3);
    EXPECT_EQ(lux.lux.size(), 6u);
    EXPECT_NEAR(lux.of(0)[0], 300.0f, 0.01f);
    EXPECT_NEAR(lux.of(0)[1], 8.0f, 0.001f);
    EXPECT_EQ(lux.of(1)[0], 0.0f);
    EXPECT_NEAR(lux.of(2)[0], 150.0f, 4.0f);
}

TEST(Bounce, comes_from_all_around_in_a_closed_box) {
    Room box;
    box.scene().materials[0].base_color = glm::vec3(0.5f);
    box.box({-2, -1, -2}, {2, 2, 2});
    const std::vector<Sensor> sensors = {{{0.3, 0.1, 0.2}, {0, 1, 0}}, {{0.3, 0.1, 0.2}, {0.6f, 0.8f, 0}}};
    const Bounce coarse = bounce_in(box, sensors, 1.0), fine = bounce_in(box, sensors, 0.25);
    for (const std::size_t s : {0u, 1u}) EXPECT_NEAR(share_of(coarse, s), 0.5, 1e-5);
    EXPECT_LT(coarse.points.size(), fine.points.size());
    for (const Sensor& point : coarse.points) {
        const glm::dvec3 inside = point.position + 0.1 * glm::dvec3(point.normal);
        EXPECT_TRUE(std::abs(inside.x) < 2.0 && std::abs(inside.z) < 2.0 && inside.y > -1.0 && inside.y < 2.0);
    }
}

TEST(Bounce, passes_glass_with_its_tint) {
    Room glazed = open_field();
    glazed.scene().materials[0].base_color = glm::vec3(0.5f);
    glazed.scene().materials.emplace_back();
    glazed.scene().materials[1].model = render::Material::Model::glass;
    glazed.scene().materials[1].base_color = glm::vec3(0.8f);
    glazed.scene().materials[1].transmission = 1.0f;
    glazed.quad({-400, -0.5f, -400}, {-400, -0.5f, 400}, {400, -0.5f, 400}, {400, -0.5f, -400});
    for (std::size_t t = 2; t < 4; ++t) glazed.scene().triangle_material[t] = 1;
    const Bounce bounce = bounce_in(glazed, {{{0, 0, 0}, {0, -1, 0}}});
    EXPECT_NEAR(share_of(bounce, 0), 0.4, 0.01);
}

TEST(Bounce, is_the_same_for_any_number_of_Threads_and_kept_in_the_file) {
    Room shed = open_shed();
    const SensorSet sensors = sensors_of({{-2, 0, -2}, {2, 0, 2}, 1.0}, UpAxis::y);
    const Bounce one = bounce_in(shed, sensors.sensors, 0.5, 1), two = bounce_in(shed, sensors.sensors, 0.5, 2);
    EXPECT_EQ(one.points, two.points);
    EXPECT_EQ(one.ends, two.ends);
    ASSERT_FALSE(one.points.empty());

    const DirectionTree directions = make_direction_tree(1024);
    const render::RayScene rays(shed.scene());
    std::vector<Sensor> all = sensors.sensors;
    all.insert(all.end(), one.points.begin(), one.points.end());
    const Trace trace = trace_sensors(shed.scene(), rays, directions, all, {});
    const auto bytes = visibility_file(directions, sensors, one, trace.sky, trace.sun);
    TemporaryFolder folder;
    const VisibilityFile file(
        folder.write("a.cuts", std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size())));
    EXPECT_EQ(file.all(), all);
    EXPECT_EQ(file.sensors().sensors, sensors.sensors);
    EXPECT_EQ(file.bounce().ends, one.ends);
    for (std::size_t i = 0; i < one.links.size(); ++i) {
        EXPECT_EQ(file.bounce().links[i].point, two.links[i].point);
        EXPECT_EQ(file.bounce().links[i].share, two.links[i].share);
    }
}

}  // namespace
