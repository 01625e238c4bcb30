#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <render/io/validate.hpp>
#include <render/lights/emitters.hpp>
#include <render/lights/indirect.hpp>
#include <render/lights/spheres.hpp>
#include <render/motion.hpp>
#include <render/moving_view.hpp>
#include <render/rays/ray_scene.hpp>
#include <render/render_loop.hpp>
#include <render/shader.hpp>
#include <render/surfaces/surface_geometry.hpp>
#include <render/view.hpp>

#include "refusal.hpp"

namespace {

using render::Options;
using render::RayScene;
using render::RigidMotion;
using render::Scene;
using render::Shutter;
using render::ShutterShape;
using testing::HasSubstr;

constexpr double pi = std::numbers::pi;

/// A level square that faces up, or down. Returns its first vertex.
std::uint32_t add_level(Scene& s, const glm::vec3& at, const glm::vec2& half, std::uint32_t material = 0,
                        bool faces_up = true) {
    const auto first = static_cast<std::uint32_t>(s.positions.size());
    for (const glm::vec2 d : {glm::vec2(-1, -1), {-1, 1}, {1, 1}, {1, -1}}) {
        s.positions.push_back(at + glm::vec3(d.x * half.x, 0.0f, d.y * half.y));
    }
    for (const glm::uvec3 t : {glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)}) {
        s.triangles.push_back(first + (faces_up ? t : glm::uvec3(t.x, t.z, t.y)));
        s.triangle_material.push_back(material);
    }
    return first;
}

/// A floor of albedo 0.5 about the origin.
Scene floor_scene() {
    Scene s;
    s.name = "floor";
    s.materials.resize(2);
    for (render::Material& m : s.materials) m.model = render::Material::Model::phong;
    s.materials[0].base_color = glm::vec3(0.5f);
    s.materials[1].base_color = glm::vec3(0.0f);
    s.materials[1].emission = glm::vec3(40.0f, 30.0f, 20.0f);
    add_level(s, glm::vec3(0.0f), glm::vec2(20.0f));
    return s;
}

void set_in_motion(Scene& s, const Shutter& shutter) {
    render::apply_rigid_motions(s, shutter);
    render::set_instants(s, shutter);
    render::validate(s);
}

/// Looks at the origin from the side; a pixel is much smaller than anything changes over.
render::Camera close_camera() {
    render::Camera camera;
    camera.eye = {0.0, 2.0, 8.0};
    camera.target = {0.0, 0.0, 0.0};
    camera.height = 1e-3;
    return camera;
}

Options options_of(const std::string& method, int spp) {
    Options options;
    options.method = method;
    options.spp = spp;
    options.quiet = true;
    options.clamp = {};
    return options;
}

render::Picture picture_of(const Scene& s, const Options& options, int size = 1) {
    const RayScene rays(s);
    const auto shader = render::make_shader(s, rays, options);
    const render::EyePathTracer surfaces(s, rays, render::Shade::full);
    const render::MovingView view(close_camera(), s, size, size);
    return render::render_picture(view, surfaces, *shader, options).picture;
}

float pixel_of(const Scene& s, const Options& options) { return picture_of(s, options).pixels.at(0).x; }

TEST(MovingView, LooksFromThePoseOfEachInstant) {
    Scene s = floor_scene();
    s.origin = {1, 2, 3};
    render::Camera camera = close_camera();
    camera.at_instants = {{{0, 2, 8}, {0, 0, 0}, {0, 1, 0}}, {{4, 2, 8}, {1, 0, 0}, {0, 1, 0.5f}}};
    s.instants = {0.25f, 0.75f};
    const render::MovingView moving(camera, s, 8, 6);
    EXPECT_EQ(moving.instants(), 2u);
    for (std::uint32_t t = 0; t < 2; ++t) {
        const render::View still(render::posed(camera, camera.at_instants[t]), s.origin, 8, 6);
        EXPECT_EQ(moving.at(t).ray(2.5f, 1.5f).origin, still.ray(2.5f, 1.5f).origin);
        EXPECT_EQ(moving.at(t).ray(2.5f, 1.5f).direction, still.ray(2.5f, 1.5f).direction);
    }
    EXPECT_NE(moving.at(0).ray(0, 0).origin, moving.at(1).ray(0, 0).origin);
}

/// A wheel of blades about an oblique axis, with slanted faces and vertex normals.
struct Wheel {
    Scene scene = floor_scene();
    RigidMotion motion;

    explicit Wheel(double turn) {
        motion.center = {1.0, 3.0, -2.0};
        motion.axis = glm::normalize(glm::dvec3(1.0, 2.0, 0.5));
        motion.turn = turn;
        motion.velocity = {0.25, -0.5, 1.0};
        motion.first_vertex = static_cast<std::uint32_t>(scene.positions.size());
        for (int blade = 0; blade < 5; ++blade) {
            const auto first = static_cast<std::uint32_t>(scene.positions.size());
            const glm::dmat3 there(glm::rotate(glm::dmat4(1.0), blade * 2.0 * pi / 5.0, motion.axis));
            for (const glm::dvec3 p : {glm::dvec3(0.2, 0.0, 0.1), {2.0, 0.3, -0.4}, {1.8, -0.2, 0.7}}) {
                scene.positions.emplace_back(motion.center + there * p);
            }
            scene.triangles.emplace_back(first, first + 1, first + 2);
            scene.triangle_material.push_back(0);
        }
        motion.vertex_count = static_cast<std::uint32_t>(scene.positions.size()) - motion.first_vertex;
        scene.normals.resize(scene.positions.size(), glm::vec3(0.0f));
        for (std::size_t v = motion.first_vertex; v < scene.positions.size(); ++v) {
            scene.normals[v] = glm::normalize(glm::vec3(0.3f, 1.0f, 0.1f * static_cast<float>(v % 3)));
        }
        scene.rigid_motions.push_back(motion);
    }

    glm::dvec3 moved(const glm::dvec3& p, double second) const {
        const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), motion.turn * second, motion.axis));
        return motion.center + turn * (p - motion.center) + second * motion.velocity;
    }
};

TEST(Motion, FollowsARotationClosely) {
    const Scene still = Wheel(0.0).scene;
    for (const double turns : {0.01, 0.25, 1.0, 2.0}) {
        SCOPED_TRACE(turns);
        Wheel wheel(turns * 2.0 * pi);
        const Shutter shutter{0.5, 1.0, 8, ShutterShape::box};
        set_in_motion(wheel.scene, shutter);
        ASSERT_EQ(wheel.scene.moving.size(), 1u);
        EXPECT_EQ(render::motion_of(wheel.scene, 0), nullptr) << "the floor";
        double largest = 0.0;
        for (std::uint32_t t = 2; t < wheel.scene.triangles.size(); ++t) {
            const render::Triangle original(still, t);
            for (int i = 0; i <= 200; ++i) {
                const double time = i / 200.0;
                const render::Triangle at = render::triangle_at(wheel.scene, t, static_cast<float>(time));
                const double second = shutter.second_at(time);
                largest = std::max({largest, glm::length(at.a - wheel.moved(original.a, second)),
                                    glm::length(at.b - wheel.moved(original.b, second)),
                                    glm::length(at.c - wheel.moved(original.c, second))});
            }
        }
        // Its extent is 4; of two whole turns in the 128 steps that there are at most, the sagitta is larger.
        EXPECT_LT(largest, turns > 1.0 ? 3e-3 : 1.1e-3);
        if (turns < 0.1) { EXPECT_LE(wheel.scene.moving[0].steps, 5u) << "a small turn takes few steps"; }
    }
}

TEST(Motion, OfAStraightLineTakesOneStep) {
    Scene s = floor_scene();
    const std::uint32_t first = add_level(s, {0, 1, 0}, glm::vec2(1.0f));
    s.rigid_motions.push_back({first, 4, {}, {0, 1, 0}, 0.0, {3, 0, 1}});
    set_in_motion(s, {0.0, 2.0, 4, ShutterShape::box});
    ASSERT_EQ(s.moving.size(), 1u);
    EXPECT_EQ(s.moving[0].steps, 2u);
    EXPECT_EQ(render::triangle_at(s, 2, 0.5f).a, glm::dvec3(s.positions[first]) + glm::dvec3(3, 0, 1));
}

TEST(Motion, TakesSphericalLightsAlong) {
    const Shutter shutter{0.5, 2.0, 5, ShutterShape::box};
    Wheel wheel(1.5 * pi);
    const lightcuts::SphereLight<> lamp{{0.5f, 2.0f, -1.0f}, 0.25f, {3.0f, 2.0f, 1.0f}};
    wheel.scene.spheres = {{{9.0f, 1.0f, 0.0f}, 0.5f, glm::vec3(1.0f)}, lamp};
    wheel.motion.first_sphere = 1;
    wheel.motion.sphere_count = 1;
    wheel.scene.rigid_motions = {wheel.motion};
    Scene still = wheel.scene;
    set_in_motion(wheel.scene, shutter);
    ASSERT_EQ(wheel.scene.spheres.size(), 1u) << "the other one stands still";
    EXPECT_EQ(wheel.scene.spheres[0].radius, 0.5f);
    ASSERT_EQ(wheel.scene.at_instants.spheres.size(), 5u);
    for (std::uint32_t t = 0; t < 5; ++t) {
        const auto& light = wheel.scene.at_instants.spheres[t];
        EXPECT_EQ(light.instant, t);
        EXPECT_EQ(light.radius, lamp.radius);
        EXPECT_EQ(light.intensity, lamp.intensity);
        const double second = shutter.second_at(static_cast<double>(wheel.scene.instants[t]));
        const glm::dvec3 there = wheel.moved(glm::dvec3(lamp.center), second);
        EXPECT_LT(glm::distance(glm::dvec3(light.center), there), 1e-5);
    }

    set_in_motion(still, {0.5, 0.0, 5, ShutterShape::box});
    ASSERT_EQ(still.spheres.size(), 2u);
    EXPECT_TRUE(still.at_instants.spheres.empty());
    const glm::dvec3 there = wheel.moved(glm::dvec3(lamp.center), 0.5);
    EXPECT_LT(glm::distance(glm::dvec3(still.spheres[1].center), there), 1e-5);
}

TEST(Motion, OfNothingIsNone) {
    Scene s = floor_scene();
    s.rigid_motions.push_back({0, 4, {}, {0, 1, 0}, 0.0, {0, 0, 0}});
    set_in_motion(s, {0.0, 2.0, 4, ShutterShape::box});
    EXPECT_TRUE(s.is_still());
    EXPECT_TRUE(s.moving.empty());
}

TEST(Motion, ThatIsTooFastIsNamed) {
    for (const double turns : {30.0, 40.0}) {
        Wheel wheel(turns * 2.0 * pi);
        set_in_motion(wheel.scene, {0.0, 1.0, 8, ShutterShape::box});
        EXPECT_EQ(wheel.scene.moving.at(0).steps, 129u);
        EXPECT_EQ(wheel.scene.left_out.size(), turns > 32.0 ? 1u : 0u) << turns;
    }
}

TEST(Motion, MovesNoTriangleByHalf) {
    Scene s = floor_scene();
    s.rigid_motions.push_back({0, 2, {}, {0, 1, 0}, 0.0, {1, 0, 0}});
    EXPECT_THAT(refusal([&] { set_in_motion(s, {0.0, 2.0, 4, ShutterShape::box}); }), HasSubstr("some of its corners"));
}

TEST(Motion, IsMetByRaysAtTheirTime) {
    const Scene still = Wheel(0.0).scene;
    Wheel wheel(1.5 * pi);
    const Shutter shutter{0.25, 2.0, 8, ShutterShape::box};
    set_in_motion(wheel.scene, shutter);
    const RayScene rays(wheel.scene);
    int hits = 0;
    for (std::uint32_t t = 2; t < still.triangles.size(); ++t) {
        for (int i = 0; i < 50; ++i) {
            SCOPED_TRACE("triangle " + std::to_string(t) + ", time " + std::to_string(i));
            const double time = (i + 0.37) / 50.0;
            const double second = shutter.second_at(time);
            const render::Triangle original(still, t);
            const glm::dvec3 place = original.at(0.3, 0.25);
            const glm::dvec3 there = wheel.moved(place, second);
            const glm::dmat3 turn(glm::rotate(glm::dmat4(1.0), wheel.motion.turn * second, wheel.motion.axis));
            const glm::dvec3 normal = glm::normalize(turn * original.cross());
            const glm::vec3 from(there + 0.05 * normal);
            const glm::vec3 way(-normal);
            const auto hit = rays.nearest(from, way, static_cast<float>(time));
            if (!hit || hit->triangle != t) continue;  // another blade or the floor is between
            ++hits;
            const render::SurfaceGeometry surface = render::surface_at(wheel.scene, *hit, way);
            EXPECT_LT(glm::length(glm::dvec3(surface.position) - there), 2e-3);
            EXPECT_LT(glm::length(glm::dvec3(surface.geometric_normal) - normal), 5e-3);
            const glm::uvec3 c = still.triangles[t];
            const glm::dvec3 smooth = glm::normalize(turn * (0.45 * glm::dvec3(still.normals[c.x]) +
                                                             0.3 * glm::dvec3(still.normals[c.y]) +
                                                             0.25 * glm::dvec3(still.normals[c.z])));
            const double side = glm::dot(smooth, normal) < 0.0 ? -1.0 : 1.0;
            if (std::abs(glm::dot(smooth, normal)) < 0.05) continue;  // bent towards the viewer
            EXPECT_LT(glm::length(glm::dvec3(surface.shading_normal) - side * smooth), 1e-2);
            // A shadow ray through the place is stopped at this time, and not when the blade is elsewhere.
            const glm::vec3 to(there - 0.05 * normal);
            EXPECT_EQ(rays.to_point(from, to, static_cast<float>(time)), glm::vec3(0.0f));
        }
    }
    EXPECT_GT(hits, 200);
}

/// A card that crosses the way from the origin to an omni light 4 above it, in the middle sixth of the time.
Scene crossing_card(const Shutter& shutter, bool is_glass = false) {
    Scene s = floor_scene();
    if (is_glass) {
        s.materials.push_back(s.materials[0]);
        s.materials.back().alpha = render::Material::Alpha::blend;
        s.materials.back().base_alpha = 0.25f;
    }
    const std::uint32_t first = add_level(s, {-3.0f, 2.0f, 0.0f}, {0.5f, 1.0f}, is_glass ? 2 : 0);
    s.rigid_motions.push_back({first, 4, {}, {0, 1, 0}, 0.0, {6.0 / shutter.seconds, 0, 0}});
    s.omni.push_back({{0, 4, 0}, glm::vec3(10.0f)});
    set_in_motion(s, shutter);
    return s;
}

TEST(MovingOccluder, TakesAsMuchLightAsItTakesTime) {
    constexpr std::uint32_t instants = 256;
    const double unshadowed = 0.5 / pi * 10.0 / 16.0;
    for (const ShutterShape shape : {ShutterShape::box, ShutterShape::gaussian}) {
        const Shutter shutter{0.0, 0.1, instants, shape};
        // Of the Gaussian that ends at two standard deviations, the part within a sixth of the time about the middle.
        const double hidden = shape == ShutterShape::box
                                  ? 1.0 / 6.0
                                  : std::erf(1.0 / 3.0 / std::sqrt(2.0)) / std::erf(2.0 / std::sqrt(2.0));
        const Scene s = crossing_card(shutter);
        for (const char* method : {"exhaustive", "lightcuts", "ward", "power", "tree-sampling", "adaptive-splitting",
                                   "stochastic-lightcuts", "multidimensional"}) {
            Options options = options_of(method, instants);
            options.samples = 1;
            options.error_ratio = 0.0f;
            options.max_cut = 0;
            options.given = {"--max-cut"};
            // One instant on either side of the card's edges.
            EXPECT_NEAR(static_cast<double>(pixel_of(s, options)), (1.0 - hidden) * unshadowed,
                        2.0 / instants * unshadowed)
                << method;
        }
        Options options = options_of("multidimensional", instants);
        EXPECT_NEAR(static_cast<double>(pixel_of(s, options)), (1.0 - hidden) * unshadowed, 0.05 * unshadowed)
            << "with the usual error ratio";
    }
}

TEST(MovingOccluder, MayLetSomeLightPass) {
    const Shutter shutter{0.0, 0.1, 64, ShutterShape::box};
    const Scene s = crossing_card(shutter, true);
    const double unshadowed = 0.5 / pi * 10.0 / 16.0;
    for (const char* method : {"exhaustive", "multidimensional"}) {
        Options options = options_of(method, 64);
        options.error_ratio = 0.0f;
        EXPECT_NEAR(static_cast<double>(pixel_of(s, options)), (1.0 - 0.25 / 6.0) * unshadowed, 2.0 / 64 * unshadowed)
            << method;
    }
}

TEST(MovingLight, LightsAsItDoesOnAverage) {
    constexpr std::uint32_t instants = 32;
    const Shutter shutter{0.0, 1.0, instants, ShutterShape::gaussian};
    // A lamp that turns about an axis above the floor, under which a post stands, still light beside it.
    const auto lamp_scene = [](double second, double open) {
        Scene s = floor_scene();
        add_level(s, {0.6f, 0.5f, 0.0f}, {0.3f, 0.3f});
        const std::uint32_t lamp = add_level(s, {2.0f, 2.0f, 0.0f}, {0.25f, 0.5f}, 1, false);
        s.omni.push_back({{-1, 3, 1}, glm::vec3(1.0f)});
        s.rigid_motions.push_back({lamp, 4, {0.0, 2.0, 0.0}, {0, 1, 0}, 1.0, {-1.0, 0.5, 0.0}});
        const Shutter own{second, open, instants, ShutterShape::gaussian};
        set_in_motion(s, own);
        render::add_emitter_lights(s, {.points = 16});
        return s;
    };
    double average = 0.0;
    for (const float time : render::times_of_instants(shutter)) {
        const Scene s = lamp_scene(static_cast<double>(time), 0.0);
        EXPECT_EQ(s.oriented.size(), 16u);
        average += static_cast<double>(pixel_of(s, options_of("exhaustive", 1))) / instants;
    }
    ASSERT_GT(average, 0.05);

    const Scene s = lamp_scene(0.0, 1.0);
    EXPECT_EQ(s.oriented.size(), 0u);
    EXPECT_EQ(s.at_instants.oriented.size(), 16u * instants);
    Options options = options_of("multidimensional", instants);
    EXPECT_NEAR(static_cast<double>(pixel_of(s, options)), average, 0.05 * average);
    options.error_ratio = 0.0f;
    options.max_cut = 0;
    options.given = {"--max-cut"};
    EXPECT_NEAR(static_cast<double>(pixel_of(s, options)), average, 2e-3 * average) << "all pairs one by one";
}

TEST(MovingLight, MayBeASphereAroundWhatItContains) {
    constexpr std::uint32_t instants = 8;
    const auto sphere_at = [](std::uint32_t t) {
        return lightcuts::SphereLight<>{{0.2f * static_cast<float>(t) - 0.8f, 2.0f, 0.0f}, 0.5f, glm::vec3(3.0f)};
    };
    // Inside the spheres is a card, which casts no shadow, and below them one that does.
    Scene around = floor_scene();
    add_level(around, {0.0f, 2.0f, 0.0f}, {1.2f, 0.05f});
    add_level(around, {-0.8f, 1.0f, 0.0f}, {0.5f, 1.0f});
    double average = 0.0;
    double indirect = 0.0;
    for (std::uint32_t t = 0; t < instants; ++t) {
        Scene s = around;
        s.spheres.push_back(sphere_at(t));
        render::add_sphere_lights(s, 16, 1);
        average += static_cast<double>(pixel_of(s, options_of("exhaustive", 1))) / instants;
        render::add_virtual_lights(s, RayScene(s), 500, render::Shade::full, 1);
        for (const auto& light : s.virtual_lights) indirect += static_cast<double>(light.intensity.x) / instants;
    }
    Scene s = around;
    for (std::uint32_t t = 0; t < instants; ++t) s.at_instants.spheres.push_back({sphere_at(t), t});
    render::set_instants(s, {0.0, 1.0, instants, ShutterShape::box});
    render::add_sphere_lights(s, 16, 1);
    EXPECT_EQ(s.light_count(), 16u * instants);
    Options options = options_of("multidimensional", instants);
    options.error_ratio = 0.0f;
    options.max_cut = 0;
    options.given = {"--max-cut"};
    EXPECT_NEAR(static_cast<double>(pixel_of(s, options)), average, 2e-3 * average);
    render::add_virtual_lights(s, RayScene(s), 500 * instants, render::Shade::full, 1);
    double sum = 0.0;
    for (const auto& light : s.at_instants.virtual_lights) sum += static_cast<double>(light.intensity.x) / instants;
    EXPECT_NEAR(sum, indirect, 0.03 * indirect);
}

TEST(MovingLight, IsSeenWhereItIs) {
    Scene s = floor_scene();
    const std::uint32_t lamp = add_level(s, {-3.0f, 0.01f, 0.0f}, {0.5f, 1.0f}, 1);
    s.rigid_motions.push_back({lamp, 4, {}, {0, 1, 0}, 0.0, {6, 0, 0}});
    set_in_motion(s, {0.0, 1.0, 64, ShutterShape::box});
    s.omni.push_back({{0, 4, 0}, glm::vec3(0.01f)});
    // A sixth of the time it is in the pixel.
    EXPECT_NEAR(pixel_of(s, options_of("lightcuts", 64)), 40.0f / 6.0f, 40.0f / 64.0f);
}

/// The indirect light of all instants together has the power of that of a still scene.
TEST(MovingLight, IsReflectedAtItsInstant) {
    const Shutter shutter{0.0, 1.0, 8, ShutterShape::box};
    const auto power = [](const auto& lights) {
        double sum = 0.0;
        for (const auto& light : lights) sum += static_cast<double>(light.intensity.x);
        return sum;
    };
    const Scene moving = [&] {
        Scene s = floor_scene();
        s.omni.push_back({{5, 2, 0}, glm::vec3(10.0f)});
        // Far from the light, so that little changes.
        const std::uint32_t first = add_level(s, {-19.0f, 0.5f, 19.0f}, {0.1f, 0.1f});
        s.rigid_motions.push_back({first, 4, {}, {0, 1, 0}, 0.0, {0.1, 0, 0}});
        set_in_motion(s, shutter);
        render::add_virtual_lights(s, RayScene(s), 8000, render::Shade::full, 1);
        return s;
    }();
    Scene still = floor_scene();
    still.omni = moving.omni;
    render::add_virtual_lights(still, RayScene(still), 1000, render::Shade::full, 1);
    EXPECT_TRUE(moving.virtual_lights.empty());
    const auto& lights = moving.at_instants.virtual_lights;
    EXPECT_NEAR(static_cast<double>(lights.size()), 8000.0, 800.0);
    std::vector<double> by_instant(8);
    for (const auto& light : lights) by_instant.at(light.instant) += static_cast<double>(light.intensity.x);
    for (const double sum : by_instant)
        EXPECT_NEAR(sum, power(still.virtual_lights), 0.1 * power(still.virtual_lights));
}

/// Its virtual lights are fewer at each instant and stronger; each may add as much to the pixel as in a still picture.
TEST(MovingLight, IsClampedAsStillLightIs) {
    constexpr std::uint32_t instants = 16;
    // A corner: the floor near a wall is where light is clamped.
    const auto corner = [] {
        Scene s = floor_scene();
        const auto first = static_cast<std::uint32_t>(s.positions.size());
        for (const glm::vec3 p : {glm::vec3(-0.5f, 0, 2), {-0.5f, 0, -2}, {-0.5f, 4, -2}, {-0.5f, 4, 2}}) {
            s.positions.push_back(p);
        }
        for (const glm::uvec3 t : {glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)}) {
            s.triangles.push_back(first + t);
            s.triangle_material.push_back(0);
        }
        s.omni.push_back({{1.5f, 1.0f, 0.0f}, glm::vec3(10.0f)});
        return s;
    };
    const auto pixel = [&](Scene& s, int spp, bool clamps) {
        render::add_virtual_lights(s, RayScene(s), 4000, render::Shade::full, 1);
        // Indirect light alone.
        s.omni.clear();
        Options options = options_of("multidimensional", spp);
        options.error_ratio = 0.002f;
        options.max_cut = 0;
        options.given = {"--max-cut"};
        options.adaptation = 0.1f;
        if (clamps) options.clamp = lightcuts::automatic_clamping;
        return static_cast<double>(pixel_of(s, options));
    };
    Scene still = corner();
    const double wanted = pixel(still, 1, true);
    Scene unclamped = corner();
    ASSERT_LT(wanted, 0.9 * pixel(unclamped, 1, false)) << "nothing to clamp";
    Scene moving = corner();
    const std::uint32_t card = add_level(moving, {-19.0f, 0.5f, 19.0f}, {0.1f, 0.1f});
    moving.rigid_motions.push_back({card, 4, {}, {0, 1, 0}, 0.0, {0.1, 0, 0}});
    set_in_motion(moving, {0.0, 1.0, instants, ShutterShape::box});
    EXPECT_NEAR(pixel(moving, instants, true), wanted, 0.07 * wanted);
}

TEST(Motion, IsTheSameForAnyNumberOfThreads) {
    const auto picture = [](int threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                        static_cast<std::size_t>(threads));
        tbb::task_arena arena(threads);
        render::Picture result;
        arena.execute([&] {
            Wheel wheel(pi);
            wheel.scene.omni.push_back({{0, 6, 3}, glm::vec3(20.0f)});
            add_level(wheel.scene, {1.0f, 5.0f, 1.0f}, glm::vec2(0.3f), 1, false);
            wheel.scene.normals.resize(wheel.scene.positions.size(), glm::vec3(0.0f));
            const auto lamp = static_cast<std::uint32_t>(wheel.scene.positions.size()) - 4;
            wheel.scene.rigid_motions.push_back({lamp, 4, {}, {0, 1, 0}, 0.5, {0, 0, 0}});
            set_in_motion(wheel.scene, {0.0, 1.0, 16, ShutterShape::gaussian});
            render::add_emitter_lights(wheel.scene, {.points = 4});
            render::add_virtual_lights(wheel.scene, RayScene(wheel.scene), 400, render::Shade::full, 1);
            result = picture_of(wheel.scene, options_of("multidimensional", 4), 40);
        });
        return result;
    };
    const render::Picture one = picture(1);
    EXPECT_EQ(one.pixels, picture(4).pixels);
    EXPECT_GT(one.pixels.at(800).x, 0.0f);
}

}  // namespace
