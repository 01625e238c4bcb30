#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <render/motion.hpp>

#include "render/gltf_builder.hpp"
#include "render/programs.hpp"
#include "render/refusal.hpp"

namespace {

using Json = nlohmann::json;
using render::Scene;
using render::Shutter;
using render::ShutterShape;
using testing::HasSubstr;

const float half_root = std::sqrt(0.5f);

/// Adds a channel with keys at `times` to the first animation.
void animate(GltfBuilder& file, std::size_t node, const char* path, const std::vector<float>& times,
             const std::vector<float>& values, const char* interpolation = "LINEAR") {
    const std::size_t size = std::string(path) == "rotation" ? 4 : std::string(path) == "weights" ? 1 : 3;
    const std::size_t input = file.add(times, "SCALAR", 1);
    const std::size_t output = file.add(values, size == 4 ? "VEC4" : size == 3 ? "VEC3" : "SCALAR", size);
    if (!file.json.contains("animations")) {
        file.append("animations", {{"samplers", Json::array()}, {"channels", Json::array()}});
    }
    Json& animation = file.json["animations"][0];
    animation["channels"].push_back(
        {{"sampler", animation["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
    animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
}

/// A square on y = 0, x from 1 to 2, z from -1 to 1, of a node of its own.
GltfBuilder one_square(const Json& node = Json::object()) {
    GltfBuilder file;
    Json whole = node;
    whole["mesh"] = file.add_mesh(file.square(1.0f));
    file.add_node(whole);
    return file;
}

/// The vertex that the mesh has at (1, 0, 1), in the world, at second `second`.
glm::dvec3 corner_at(const GltfBuilder& file, double second) {
    const Scene s = file.load({second, 0.0, 1, ShutterShape::box});
    EXPECT_TRUE(s.is_still());
    return glm::dvec3(s.positions.at(0)) + s.origin;
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-5) {
    EXPECT_LE(glm::length(a - b), tolerance)
        << a.x << " " << a.y << " " << a.z << " not " << b.x << " " << b.y << " " << b.z;
}

TEST(GltfAnimation, MovesAlongStraightLines) {
    GltfBuilder file = one_square();
    animate(file, 0, "translation", {0.5f, 1.5f, 3.5f}, {1, 0, 0, 3, 0, 0, 3, 4, 0});
    expect_near(corner_at(file, 0.0), {2, 0, 1});
    expect_near(corner_at(file, 0.75), {2.5, 0, 1});
    expect_near(corner_at(file, 2.0), {4, 1, 1});
    expect_near(corner_at(file, 9.0), {4, 4, 1});
}

TEST(GltfAnimation, JumpsWhereItIsStepped) {
    GltfBuilder file = one_square();
    animate(file, 0, "scale", {0.0f, 1.0f, 2.0f}, {1, 1, 1, 2, 1, 1, 3, 1, 1}, "STEP");
    expect_near(corner_at(file, 0.99), {1, 0, 1});
    expect_near(corner_at(file, 1.0), {2, 0, 1});
    expect_near(corner_at(file, 1.5), {2, 0, 1});
    expect_near(corner_at(file, 2.5), {3, 0, 1});
}

TEST(GltfAnimation, TurnsEvenlyTheShorterWay) {
    for (const float sign : {1.0f, -1.0f}) {  // both quaternions are the same turn
        GltfBuilder file = one_square();
        animate(file, 0, "rotation", {0.0f, 3.0f}, {0, 0, 0, 1, 0, sign * half_root, 0, sign * half_root});
        // By 30 degrees about y: x to (cos, -sin), z to (sin, cos).
        const double c = std::cos(std::numbers::pi / 6.0), s = 0.5;
        expect_near(corner_at(file, 1.0), {c + s, 0, c - s});
        expect_near(corner_at(file, 3.0), {1, 0, -1});
    }
}

TEST(GltfAnimation, FollowsCubicSplines) {
    GltfBuilder file = one_square();
    // Two seconds from 0 to 1 in x, leaving at 1/s and arriving at -3/s.
    animate(file, 0, "translation", {1.0f, 3.0f}, {9, 9, 9, 0, 0, 0, 1, 0, 0, -3, 0, 0, 1, 0, 0, 9, 9, 9},
            "CUBICSPLINE");
    const auto hermite = [](double s) {
        return 2.0 * (s * s * s - 2.0 * s * s + s) * 1.0 + (-2.0 * s * s * s + 3.0 * s * s) * 1.0 +
               2.0 * (s * s * s - s * s) * -3.0;
    };
    for (const double second : {1.0, 1.5, 2.0, 2.6}) {
        expect_near(corner_at(file, second), {1.0 + hermite((second - 1.0) / 2.0), 0, 1});
    }
    EXPECT_NEAR(hermite(0.5), 1.5, 1e-12);
    expect_near(corner_at(file, 9.0), {2, 0, 1});
}

TEST(GltfAnimation, OfAParentMovesItsChildren) {
    GltfBuilder file;
    const std::size_t mesh = file.add_mesh(file.square(1.0f));
    file.append("nodes", {{"mesh", mesh}, {"translation", {0, 0, 2}}});
    file.add_node({{"children", {0}}, {"translation", {5, 0, 0}}});
    animate(file, 1, "rotation", {0.0f, 1.0f}, {0, 0, 0, 1, 0, half_root, 0, half_root});
    animate(file, 0, "scale", {0.0f, 1.0f}, {1, 1, 1, 3, 1, 1});
    // At second 1: (1, 0, 1) scaled to (3, 0, 1), moved to (3, 0, 3), turned to (3, 0, -3), moved to (8, 0, -3).
    expect_near(corner_at(file, 1.0), {8, 0, -3});
}

TEST(GltfAnimation, IsInMotionAsItIsAtEachTime) {
    // A joint, a morph target, and a node that turns, mesh by mesh.
    GltfBuilder file;
    Json attributes = file.square(1.0f);
    attributes["NORMAL"] = file.add(std::vector<float>{0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0}, "VEC3", 3);
    Json skinned = attributes;
    skinned["JOINTS_0"] = file.add(std::vector<std::uint8_t>{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4",
                                   4);
    skinned["WEIGHTS_0"] = file.add(std::vector<float>{1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 0, 1, 0, 0, 0.25f, 0.75f, 0, 0},
                                    "VEC4", 4);
    const Json target = {{"POSITION", file.add(std::vector<float>{1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3)}};
    file.add_node({{"translation", {0, 1, 0}}});
    file.add_node({{"translation", {0, 2, 0}}});
    file.append("skins", {{"joints", {0, 1}}});
    file.add_node({{"mesh", file.add_mesh(skinned)}, {"skin", 0}});
    file.add_node({{"mesh", file.add_mesh(attributes, {{"targets", Json::array({target})}})}});
    file.add_node({{"mesh", file.add_mesh(attributes)}});
    animate(file, 1, "rotation", {0.0f, 1.0f, 2.0f}, {0, 0, 0, 1, 1, 0, 0, 0, 0, half_root, 0, half_root});
    animate(file, 3, "weights", {0.0f, 2.0f}, {0, 2});
    animate(file, 4, "rotation", {0.0f, 2.0f}, {0, 0, 0, 1, 0, 0, half_root, half_root});
    const Shutter shutter{0.5, 1.25, 8, ShutterShape::box};
    const Scene moving = file.load(shutter);
    ASSERT_EQ(moving.moving.size(), 3u);
    EXPECT_EQ(moving.instants.size(), 8u);
    EXPECT_TRUE(moving.left_out.empty());
    for (int i = 0; i <= 20; ++i) {
        if (i == 8) continue;  // where the joint turns back at once, at second 1, within a step
        const double time = i / 20.0;
        const Scene still = file.load({shutter.second_at(time), 0.0, 1, ShutterShape::box});
        ASSERT_EQ(still.triangles, moving.triangles);
        for (std::uint32_t t = 0; t < still.triangles.size(); ++t) {
            SCOPED_TRACE("triangle " + std::to_string(t) + " at " + std::to_string(time));
            const render::Triangle a = render::triangle_at(moving, t, static_cast<float>(time));
            const render::Triangle b(still, t);
            expect_near(a.a + moving.origin, b.a + still.origin, 2e-3);
            expect_near(a.b + moving.origin, b.b + still.origin, 2e-3);
            expect_near(a.c + moving.origin, b.c + still.origin, 2e-3);
            const auto normals = render::normals_at(moving, t, static_cast<float>(time));
            expect_near(glm::dvec3(normals[0]), glm::dvec3(still.normals[still.triangles[t].x]), 0.01);
        }
    }
}

TEST(GltfAnimation, MovesCamerasAndLights) {
    GltfBuilder file = one_square();
    file.append("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}}}});
    file.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array(
        {{{"type", "point"}},
         {{"type", "spot"}, {"spot", Json::object()}},
         {{"type", "directional"}},
         {{"type", "point"}, {"extras", {{"radius", 0.5}}}}});
    const std::size_t rig = file.add_node({{"camera", 0}, {"translation", {0, 0, 5}}});
    for (int i = 0; i < 4; ++i) file.add_node({{"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    const std::size_t still = file.add_node({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    for (std::size_t node = rig; node < still; ++node) {
        animate(file, node, "translation", {0.0f, 4.0f}, {0, 0, 5, 8, 0, 5});
        animate(file, node, "rotation", {0.0f, 4.0f}, {0, 0, 0, 1, 0, half_root, 0, half_root});
    }
    animate(file, still, "translation", {1.0f}, {0, 3, 0});
    const Shutter shutter{0.0, 4.0, 2, ShutterShape::box};  // seconds 1 and 3
    const Scene s = file.load(shutter);
    EXPECT_EQ(s.omni.size(), 1u) << "one that an animation holds still";
    ASSERT_EQ(s.at_instants.omni.size(), 2u);
    ASSERT_EQ(s.at_instants.spots.size(), 2u);
    ASSERT_EQ(s.at_instants.directional.size(), 2u);
    ASSERT_EQ(s.at_instants.spheres.size(), 2u);
    EXPECT_TRUE(s.left_out.empty());
    ASSERT_EQ(s.cameras.at(0).at_instants.size(), 2u);
    for (std::uint32_t t = 0; t < 2; ++t) {
        const double second = 1.0 + 2.0 * t;
        const double angle = second / 4.0 * std::numbers::pi / 2.0;
        const glm::dvec3 position(2.0 * second, 0.0, 5.0);
        const glm::dvec3 forward(-std::sin(angle), 0.0, -std::cos(angle));
        EXPECT_EQ(s.at_instants.omni[t].instant, t);
        expect_near(glm::dvec3(s.at_instants.omni[t].position) + s.origin, position);
        expect_near(glm::dvec3(s.at_instants.spots[t].position) + s.origin, position);
        expect_near(glm::dvec3(s.at_instants.spots[t].axis), forward);
        expect_near(glm::dvec3(s.at_instants.spheres[t].center) + s.origin, position);
        EXPECT_EQ(s.at_instants.spheres[t].radius, 0.5f);
        expect_near(glm::dvec3(s.at_instants.directional[t].direction), forward);
        const render::CameraPose& pose = s.cameras[0].at_instants[t];
        expect_near(pose.eye, position);
        expect_near(glm::normalize(pose.target - pose.eye), forward);
    }
    expect_near(s.cameras[0].eye, {0, 0, 5});
}

TEST(GltfAnimation, RefusesKeysThatAreNotInOrder) {
    GltfBuilder file = one_square();
    animate(file, 0, "translation", {0.0f, 2.0f, 1.0f}, {0, 0, 0, 0, 0, 0, 0, 0, 0});
    EXPECT_NO_THROW(file.load()) << "not looked at where the shutter opens with the animation";
    EXPECT_THAT(refusal([&] { file.load({0.0, 1.0, 2, ShutterShape::box}); }), HasSubstr("do not ascend"));
    GltfBuilder damaged = one_square();
    animate(damaged, 0, "translation", {0.0f, 1.0f, 2.0f},
            {0, 0, 0, 1, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0, 0});
    EXPECT_NO_THROW(damaged.load({0.0, 1.0, 2, ShutterShape::box})) << "its third key is not looked at";
    EXPECT_THAT(refusal([&] { damaged.load({0.5, 1.0, 2, ShutterShape::box}); }), HasSubstr("is not finite"));
}

/// The programs, on a file whose square turns and shines.
class MotionPrograms : public Programs {
protected:
    void write(bool shines) {
        std::filesystem::create_directory(folder.path() / GltfBuilder::folder);
        GltfBuilder file;
        const std::size_t lamp = file.add_material({{"emissiveFactor", {1, 1, 1}}});
        const std::size_t gray = file.add_material();
        file.add_node({{"mesh", file.add_mesh(file.square(), {{"material", gray}})}});
        file.add_node({{"mesh", file.add_mesh(file.square(), {{"material", shines ? lamp : gray}})},
                       {"rotation", {1, 0, 0, 0}},
                       {"translation", {0, 1, 0}}});
        file.json["extensions"]["KHR_lights_punctual"]["lights"] = Json::array({{{"type", "point"}}});
        file.add_node({{"translation", {1, 3, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
        animate(file, 1, "translation", {0.0f, 1.0f}, {0, 1, 0, 2, 1, 0});
        for (const auto& [name, bytes] : file.files()) folder.write(name, bytes);
    }

    std::string picture(const std::string& options, const std::string& scene = GltfBuilder::path) {
        const auto done = render(scene + " --size 24x18 --quiet -o p.exr" + view + options);
        EXPECT_EQ(done.status, 0) << done.err;
        return folder.read("p.exr");
    }
};

TEST_F(MotionPrograms, LeaveAStillPictureAsItIs) {
    write(true);
    for (const std::string method : {"lightcuts", "exhaustive", "multidimensional"}) {
        const std::string way = " --spp 3 --indirect 100 --method " + method;
        EXPECT_EQ(picture(way), picture(way + " --shutter 0 --instants 16 --shutter-shape box")) << method;
        EXPECT_EQ(picture(way, "room.obj"), picture(way + " --shutter 2 --instants 16", "room.obj"))
            << method << ", where nothing moves";
    }
}

TEST_F(MotionPrograms, MoveWithEveryMethodButLightWithOne) {
    write(false);
    const std::string open = " --spp 4 --shutter 1 --instants 4";
    for (const std::string method : {"lightcuts", "exhaustive", "power", "multidimensional"}) {
        const std::string way = " --method " + method;
        const std::string moving = picture(way + open);
        EXPECT_NE(moving, picture(way + " --spp 4")) << method;
        EXPECT_TRUE(report("p.json").at("motion").is_null());
    }
    picture(open);
    EXPECT_EQ(report("p.json").at("motion"), Json({{"instants", 4}, {"triangles", 2}, {"lights", 0}}));
    EXPECT_EQ(report("p.json").at("options").at("instants"), 4);
    const std::string command = std::string(GltfBuilder::path) + " --size 24x18 -o q.exr" + view + open;
    const auto indirect = render(command + " --indirect 100");
    EXPECT_EQ(indirect.status, 2);
    EXPECT_THAT(indirect.err, HasSubstr("indirect light"));
    EXPECT_TRUE(is_one_line(indirect.err));
    write(true);
    const auto refused = render(command);
    EXPECT_EQ(refused.status, 2);
    EXPECT_THAT(refused.err, HasSubstr("--method multidimensional"));
    EXPECT_TRUE(is_one_line(refused.err));
    EXPECT_FALSE(folder.has("q.exr"));
    picture(open + " --method multidimensional --indirect 100");
    EXPECT_EQ(report("p.json").at("motion").at("lights"), 4 * 64);
    EXPECT_GT(report("p.json").at("lights").at("virtual"), 50);
    // The lamp may be left out.
    picture(open + " --area-points 0");
}

TEST_F(MotionPrograms, DoNotDependOnThreads) {
    write(true);
    const std::string way =
        " --spp 5 --shutter 1 --instants 8 --method multidimensional --indirect 60 --adaptation auto";
    EXPECT_EQ(picture(way + " --threads 1"), picture(way + " --threads 3"));
}

}  // namespace
