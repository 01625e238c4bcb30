#include <cmath>
#include <cstdint>
#include <fstream>
#include <numbers>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <daylight/chunk_file.hpp>
#include <daylight/facing.hpp>
#include <daylight/node_sums.hpp>
#include <daylight/sensor_cuts.hpp>
#include <daylight/trace.hpp>
#include <daylight/visibility.hpp>
#include <daylight/visibility_file.hpp>
#include <render/refusal.hpp>
#include "support/temporary_folder.hpp"

#include "daylight/rooms.hpp"

namespace {

using namespace daylighting;
using ::testing::HasSubstr;

const DirectionTree& directions() {
    static const DirectionTree tree = make_direction_tree(8192);
    return tree;
}

/// Sensors of several normals about the open shed.
SensorSet shed_sensors() {
    SensorSet set = sensors_of({{-2.9, 0.0, -2.9}, {2.9, 0.0, 2.9}, 0.5}, UpAxis::y);
    set.columns = set.rows = 0;
    for (const glm::vec3 normal : {glm::vec3(0, 0, 1), glm::vec3(1, 0, 0), glm::vec3(0, 0.6f, 0.8f)}) {
        for (float x = -2.0f; x < 2.5f; x += 1.0f) set.sensors.push_back({{x, 1.0, 1.0}, normal});
    }
    return set;
}

/// Share of a uniform sky's light, directions weighted by the cosine, that a sensor gets.
double share_seen(Room& room, const Sensor& sensor) {
    const render::RayScene rays(room.scene());
    const Facing facing(directions(), sensor.normal);
    VisibilityTracer::Scratch scratch;
    std::vector<float> visibility;
    VisibilityTracer(room.scene(), rays, directions()).trace(sensor, facing, visibility, scratch);
    std::vector<lightcuts::Moments<1>> moments;
    facing.moments(directions().tree, visibility, moments);
    return moments.back().mean[0];
}

TEST(DirectionTree, has_directions_in_the_order_of_leaves) {
    const lightcuts::ClusterTree& tree = directions().tree;
    std::uint32_t place = 0;
    for (std::uint32_t n = 0; n < tree.size(); ++n) {
        if (!tree.is_leaf(n)) continue;
        EXPECT_EQ(tree.item(n), place);
        ++place;
    }
    EXPECT_EQ(place, directions().size());
    glm::dvec3 sum(0.0);
    for (const glm::vec3& d : directions().directions) sum += d;
    EXPECT_LT(glm::length(sum), 2e-3 * static_cast<double>(directions().size()));
    EXPECT_EQ(directions().nearest(directions().directions[1234]), 1234u);
}

TEST(Visibility, is_all_in_the_open_and_nothing_in_a_closed_box) {
    Room field = open_field();
    EXPECT_EQ(share_seen(field, {{0, 0, 0}, {0, 1, 0}}), 1.0);
    Room box;
    box.box({-2, -1, -2}, {2, 2, 2});
    for (const glm::vec3 normal : {glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::vec3(1, 0, 0)}) {
        EXPECT_EQ(share_seen(box, {{0.3, 0.1, 0.2}, normal}), 0.0);
    }
}

TEST(Visibility, beside_a_long_wall_is_what_geometry_says) {
    // Of a uniform sky a wall that hides all up to an angle t, along a horizon's half, hides (1 - cos t) / 2.
    for (const double angle : {20.0, 45.0, 70.0, 90.0}) {
        const double t = angle * std::numbers::pi / 180.0;
        const auto height = static_cast<float>(angle < 90.0 ? 10.0 * std::tan(t) : 1e4);
        Room wall;
        wall.quad({-1e4f, -1, 10}, {1e4f, -1, 10}, {1e4f, height, 10}, {-1e4f, height, 10});
        EXPECT_NEAR(share_seen(wall, {{0, 0, 0}, {0, 1, 0}}), (1.0 + std::cos(t)) / 2.0, 2e-3) << angle;
    }
}

TEST(Visibility, of_what_lies_on_a_surface_is_not_hidden_by_it) {
    Room field = open_field();
    EXPECT_EQ(share_seen(field, {{3, -1, 7}, {0, 1, 0}}), 1.0);
}

TEST(Visibility, is_partial_behind_glass) {
    Room glazed = open_field();
    glazed.scene().materials.emplace_back();
    glazed.scene().materials[1].model = render::Material::Model::glass;
    glazed.scene().materials[1].base_color = glm::vec3(0.9f, 0.6f, 0.6f);
    glazed.scene().materials[1].transmission = 1.0f;
    glazed.quad({-400, 1, -400}, {-400, 1, 400}, {400, 1, 400}, {400, 1, -400});
    for (std::size_t t = 2; t < 4; ++t) glazed.scene().triangle_material[t] = 1;
    EXPECT_NEAR(share_seen(glazed, {{0, 0, 0}, {0, 1, 0}}), 0.7, 0.01);
}

TEST(SensorCuts, are_within_the_error_and_exact_for_the_sun) {
    Room shed = open_shed();
    const render::RayScene rays(shed.scene());
    const VisibilityTracer tracer(shed.scene(), rays, directions());
    VisibilityTracer::Scratch scratch;
    CutMaker maker;
    SensorCuts cuts;
    std::vector<float> visibility;
    for (const Sensor& sensor : shed_sensors().sensors) {
        const Facing facing(directions(), sensor.normal);
        tracer.trace(sensor, facing, visibility, scratch);
        for (const double error : {0.0, 0.1, 0.4}) {
            maker.make(directions(), facing, visibility, error, cuts);
            lightcuts::validate(directions().tree, cuts.sky);
            lightcuts::validate(directions().tree, cuts.sun);
            double squared = 0.0, all = 0.0, sum = 0.0, sum_of_cut = 0.0;
            std::size_t piece = 0, sun_piece = 0;
            for (std::uint32_t i = 0; i < directions().size(); ++i) {
                while (cuts.sky.pieces()[piece].leaf_end() <= i) ++piece;
                while (cuts.sun.pieces()[sun_piece].leaf_end() <= i) ++sun_piece;
                const double w = facing.cosines()[i], v = visibility[i], a = cuts.sky.values()[piece];
                squared += w * (v - a) * (v - a);
                all += w * v * v;
                sum += w * v;
                sum_of_cut += w * a;
                EXPECT_TRUE(w < 1e-4 || cuts.sun.values()[sun_piece] == visibility[i]);
            }
            EXPECT_LE(std::sqrt(squared), error * std::sqrt(all) + 1e-4);
            EXPECT_NEAR(sum, sum_of_cut, 1e-5 * sum);
            EXPECT_LE(cuts.sky.size(), cuts.sun.size() + 1);
        }
    }
}

/// The bytes of the file that a trace makes.
std::vector<std::byte> traced(Room& room, const SensorSet& sensors, const TraceSettings& settings, int threads = 2) {
    const render::RayScene rays(room.scene());
    tbb::task_arena arena(threads);
    return arena.execute([&] {
        const Trace trace = trace_sensors(room.scene(), rays, directions(), sensors.sensors, settings);
        EXPECT_EQ(trace.finished, sensors.sensors.size());
        return visibility_file(directions(), sensors, {}, trace.sky, trace.sun);
    });
}

TEST(Trace, is_the_same_for_any_number_of_Threads) {
    Room shed = open_shed();
    const SensorSet sensors = shed_sensors();
    const auto one = traced(shed, sensors, {}, 1);
    EXPECT_EQ(one, traced(shed, sensors, {}, 2));
    EXPECT_EQ(one, traced(shed, sensors, {}, 5));
}

TEST(Trace, that_is_resumed_gives_the_same_bytes) {
    Room shed = open_shed();
    const SensorSet sensors = shed_sensors();
    TemporaryFolder folder;
    const std::string path = folder / "x.resume";
    const auto whole = traced(shed, sensors, {.unfinished = path});
    const std::string all = folder.read("x.resume");
    // Cut anywhere, or damaged anywhere: what is good is used, the rest traced anew.
    for (const std::size_t length :
         {std::size_t{0}, std::size_t{30}, std::size_t{64}, all.size() / 2, all.size() - 1}) {
        folder.write("x.resume", all.substr(0, length));
        EXPECT_EQ(traced(shed, sensors, {.unfinished = path, .resume = true}), whole) << length;
    }
    std::string damaged = all;
    damaged[all.size() / 3] = static_cast<char>(damaged[all.size() / 3] ^ 4);
    folder.write("x.resume", damaged);
    EXPECT_EQ(traced(shed, sensors, {.unfinished = path, .resume = true}), whole);
    // And what is resumed is not traced again.
    folder.write("x.resume", all);
    const render::RayScene rays(shed.scene());
    const Trace again = trace_sensors(shed.scene(), rays, directions(), sensors.sensors,
                                      {.unfinished = path, .resume = true});
    EXPECT_EQ(again.resumed, sensors.sensors.size());
}

TEST(Trace, does_not_resume_what_is_of_others) {
    Room shed = open_shed();
    SensorSet sensors = shed_sensors();
    TemporaryFolder folder;
    const std::string path = folder / "x.resume";
    traced(shed, sensors, {.unfinished = path});
    const render::RayScene rays(shed.scene());
    const auto resume = [&](double error) {
        trace_sensors(shed.scene(), rays, directions(), sensors.sensors,
                      {.error = error, .unfinished = path, .resume = true});
    };
    EXPECT_THAT(refusal([&] { resume(0.2); }), HasSubstr("leave --resume out"));
    sensors.sensors[3].position.x += 0.01;
    EXPECT_THAT(refusal([&] { resume(0.1); }), HasSubstr("leave --resume out"));
    folder.write("x.resume", "my diary");
    EXPECT_THAT(refusal([&] { traced(shed, sensors, {.unfinished = path}); }), HasSubstr("not a file of finished"));
    EXPECT_EQ(folder.read("x.resume"), "my diary");
}

TEST(VisibilityFile, gives_back_what_was_written_and_refuses_all_else) {
    Room shed = open_shed();
    SensorSet sensors = shed_sensors();
    sensors.up = UpAxis::z;
    const auto bytes = traced(shed, sensors, {});
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    TemporaryFolder folder;
    {
        const VisibilityFile file(folder.write("a.cuts", text));
        EXPECT_EQ(file.sensors().sensors, sensors.sensors);
        EXPECT_EQ(file.sensors().up, UpAxis::z);
        EXPECT_EQ(file.directions().directions, directions().directions);
        EXPECT_EQ(file.directions().tree, directions().tree);
        lightcuts::PiecewiseConstant<float> cut;
        for (std::size_t i = 0; i < sensors.sensors.size(); ++i) {
            file.read_sky(i, cut);
            file.read_sun(i, cut);
        }
    }
    const auto read_all = [](const std::string& path) {
        const VisibilityFile file(path);
        lightcuts::PiecewiseConstant<float> cut;
        for (std::size_t i = 0; i < file.sensors().sensors.size(); ++i) {
            file.read_sky(i, cut);
            file.read_sun(i, cut);
        }
    };
    for (const std::size_t length : {std::size_t{1}, std::size_t{60}, text.size() / 2, text.size() - 1}) {
        const std::string path = folder.write("b.cuts", text.substr(0, length));
        EXPECT_THAT(refusal([&] { read_all(path); }), HasSubstr(path));
    }
    for (std::size_t at = 0; at < text.size(); at += 1 + text.size() / 50) {
        std::string damaged = text;
        damaged[at] = static_cast<char>(damaged[at] ^ 16);
        const std::string path = folder.write("c.cuts", damaged);
        EXPECT_THAT(refusal([&] { read_all(path); }), HasSubstr(path)) << at;
    }
    const std::string longer = folder.write("d.cuts", text + "x");
    EXPECT_THAT(refusal([&] { read_all(longer); }), HasSubstr("after its end"));
}

TEST(NodeSums, times_a_cut_are_the_sum_over_directions) {
    const Facing facing(directions(), glm::normalize(glm::vec3(1, 2, -0.5f)));
    std::vector<HourValues> light(directions().size()), sums;
    for (std::size_t i = 0; i < light.size(); ++i) {
        for (std::size_t h = 0; h < block_hours; ++h) light[i][h] = static_cast<float>(1 + (i * 7 + h * 13) % 11);
    }
    node_sums(directions().tree, facing.cosines(), light, sums);
    const lightcuts::ClusterTree& tree = directions().tree;
    const std::uint32_t root = tree.root();
    const std::vector<CutEntry> cut = {{tree.left(root), 0.25f}, {tree.right(root), 0.75f}};
    const HourValues result = product(cut, sums);
    const std::size_t half = tree.leaf_count(tree.left(root));
    for (std::size_t h = 0; h < block_hours; ++h) {
        double sum = 0.0;
        for (std::size_t i = 0; i < light.size(); ++i) {
            sum += (i < half ? 0.25 : 0.75) * facing.cosines()[i] * light[i][h];
        }
        EXPECT_NEAR(result[h], sum, 1e-5 * sum);
    }
}

}  // namespace
