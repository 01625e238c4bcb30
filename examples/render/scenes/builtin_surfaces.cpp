#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <lightcuts/source/area.hpp>
#include <lightcuts/source/sampler.hpp>

#include "scenes/builtin.hpp"
#include "scenes/furniture.hpp"
#include "scenes/shapes.hpp"

namespace render {
namespace {

// The room: x in [-4, 4], y in [0, 3.2], z in [-3, 3].
constexpr float half_length = 4.0f;
constexpr float half_width = 3.0f;
constexpr float ceiling = 3.2f;

/// Lamps whose once-reflected light the lights stand for. They are not in the scene themselves.
struct Lamp {
    glm::vec3 position;
    glm::vec3 intensity;
};
constexpr std::array lamps{Lamp{{-2.0f, 2.6f, 0.6f}, {26.0f, 21.0f, 14.0f}},
                           Lamp{{1.9f, 2.4f, -0.9f}, {22.0f, 20.0f, 16.0f}},
                           Lamp{{3.2f, 1.7f, 2.3f}, {6.0f, 9.0f, 14.0f}}};

/// Lights lie this far off their surface, in meters.
constexpr float light_offset = 1e-3f;

/// All triangles of a scene, as if they shone alike: points of equal power are points of equal area.
struct EvenEmitter {
    const Scene& scene;

    std::size_t triangle_count() const { return scene.triangles.size(); }
    const glm::vec3& corner(std::uint32_t t, int k) const { return scene.positions[scene.triangles[t][k]]; }
    static float radiance(std::uint32_t, const glm::vec2&) { return 1.0f; }
    static bool is_textured(std::uint32_t) { return false; }
};

class Room {
public:
    Room() : m_(scene_) {
        add_shell();
        add_furniture();
        scene_.cameras.push_back({"door", {-3.6f, 1.7f, 2.6f}, {1.0f, 0.9f, -0.9f}, {0, 1, 0}, 52.0f});
        scene_.cameras.push_back({"corner", {3.5f, 2.2f, 2.5f}, {-1.2f, 0.7f, -1.0f}, {0, 1, 0}, 55.0f});
    }

    void add_lights(std::size_t count) {
        const EvenEmitter all{scene_};
        const lightcuts::EmitterSampler surfaces(all);

        // Points that the furniture hides are left out; take so many that `count` remain.
        const auto open_points = [&](std::size_t tries) {
            std::vector<Point> points = surfaces.samples(tries, lightcuts::CenteredRecurrence{});
            std::erase_if(points, [&](const Point& s) { return is_hidden(lifted(s)); });
            return points;
        };
        std::size_t tries = count + count / 4 + 16;
        std::vector<Point> open = open_points(tries);
        while (open.size() < count) open = open_points(tries += tries / 2);

        const double patch = surfaces.area() / static_cast<double>(tries) * static_cast<double>(open.size()) /
                             static_cast<double>(count);
        for (std::size_t i = 0; i < count; ++i) {
            const Point& s = open[i * open.size() / count];
            scene_.oriented.push_back({lifted(s), s.normal, reflected(s) * static_cast<float>(patch)});
        }
    }

    Scene scene() { return std::move(scene_); }

private:
    using Point = lightcuts::EmitterSample<float>;

    static glm::vec3 lifted(const Point& s) { return s.position + light_offset * s.normal; }

    bool is_hidden(const glm::vec3& p) const {
        constexpr float gap = 0.5f * light_offset;
        const bool inside = std::abs(p.x) < half_length - gap && std::abs(p.z) < half_width - gap && p.y > gap &&
                            p.y < ceiling - gap;
        return !inside || !m_.is_free(p, gap);
    }

    /// Radiance that the surface sends back of the lamps' light, without shadows.
    glm::vec3 reflected(const Point& s) const {
        glm::vec3 irradiance(0.08f);  // keeps what no lamp sees from being dark
        for (const Lamp& lamp : lamps) {
            const glm::vec3 to = lamp.position - s.position;
            const float squared = std::max(glm::dot(to, to), 0.16f);
            irradiance += lamp.intensity * (std::max(0.0f, glm::dot(to, s.normal)) / (squared * std::sqrt(squared)));
        }
        const Material& material = scene_.materials[scene_.triangle_material[s.triangle]];
        return irradiance * material.base_color * std::numbers::inv_pi_v<float>;
    }

    void add_shell() {
        const std::uint32_t wall = m_.paint("plaster", {0.75f, 0.71f, 0.64f}, 0.9f);
        const std::uint32_t accent = m_.paint("terracotta wall", {0.62f, 0.27f, 0.16f}, 0.8f);
        const std::uint32_t ceiling_paint = m_.paint("ceiling", {0.82f, 0.82f, 0.80f}, 0.9f);
        const std::uint32_t dark = m_.paint("dark tile", {0.10f, 0.11f, 0.13f}, 0.2f);
        const std::uint32_t light = m_.paint("light tile", {0.62f, 0.60f, 0.55f}, 0.22f);
        for (int i = 0; i < 16; ++i) {
            for (int j = 0; j < 12; ++j) {
                m_.material = (i + j) % 2 == 0 ? dark : light;
                m_.quad(
                    {-half_length + 0.5f * static_cast<float>(i), 0, -half_width + 0.5f * static_cast<float>(j + 1)},
                    {0.5f, 0, 0}, {0, 0, -0.5f});
            }
        }
        m_.material = ceiling_paint;
        m_.quad({-half_length, ceiling, -half_width}, {2 * half_length, 0, 0}, {0, 0, 2 * half_width}, 8, 6);
        m_.material = wall;
        m_.quad({-half_length, 0, -half_width}, {2 * half_length, 0, 0}, {0, ceiling, 0}, 8, 4);
        m_.quad({half_length, 0, half_width}, {-2 * half_length, 0, 0}, {0, ceiling, 0}, 8, 4);
        m_.quad({-half_length, 0, half_width}, {0, 0, -2 * half_width}, {0, ceiling, 0}, 6, 4);
        m_.material = accent;
        m_.quad({half_length, 0, -half_width}, {0, 0, 2 * half_width}, {0, ceiling, 0}, 6, 4);
    }

    void add_furniture() {
        const std::uint32_t oak = m_.paint("oak", {0.40f, 0.24f, 0.12f}, 0.35f);
        const std::uint32_t walnut = m_.paint("walnut", {0.20f, 0.11f, 0.06f}, 0.4f);
        const std::uint32_t brass = m_.paint("brass", {0.90f, 0.64f, 0.26f}, 0.3f, 1.0f);
        const std::uint32_t leaf = m_.paint("leaf", {0.08f, 0.28f, 0.07f}, 0.4f);
        scene_.materials[leaf].double_sided = true;
        const std::uint32_t pot = m_.paint("pot", {0.55f, 0.52f, 0.47f}, 0.5f);
        const std::uint32_t seat = m_.paint("seat", {0.10f, 0.20f, 0.34f}, 0.5f);
        const std::array glazes{m_.paint("white glaze", {0.80f, 0.79f, 0.75f}, 0.16f),
                                m_.paint("cobalt glaze", {0.03f, 0.09f, 0.45f}, 0.18f),
                                m_.paint("crimson glaze", {0.55f, 0.04f, 0.05f}, 0.2f)};
        const std::array covers{
            m_.paint("red cloth", {0.45f, 0.08f, 0.06f}, 0.6f), m_.paint("green cloth", {0.08f, 0.26f, 0.14f}, 0.6f),
            m_.paint("ochre cloth", {0.60f, 0.40f, 0.12f}, 0.6f), m_.paint("cream cloth", {0.72f, 0.68f, 0.56f}, 0.7f)};
        Dice dice(101);
        for (const float x : {-2.6f, -1.0f}) {
            m_.stand({x, 0, -half_width + 0.001f});
            add_bookcase(m_, 1.5f, 2.1f, 5, dice, walnut, covers);
        }
        m_.stand({0.7f, 0, -0.3f}, 12.0f);
        add_table(m_, 1.8f, 0.95f, oak, walnut);
        const glm::mat4 table = m_.place;
        for (int i = 0; i < 4; ++i) {
            const float side = i % 2 == 0 ? 1.0f : -1.0f;
            const glm::vec3 at(i < 2 ? -0.45f : 0.45f, 0.0f, -0.75f * side);
            m_.place = glm::rotate(glm::translate(table, at),
                                   glm::radians((side > 0.0f ? 0.0f : 180.0f) + dice.uniform(-20.0f, 20.0f)),
                                   {0, 1, 0});
            add_chair(m_, oak, seat);
        }
        m_.place = glm::translate(table, {-0.1f, 0.761f, 0.05f});
        add_vase(m_, 2, 0.34f, 28, glazes[1]);
        m_.place = glm::translate(table, {0.5f, 0.761f, -0.1f});
        add_book_stack(m_, 5, dice, covers);
        m_.place = glm::translate(table, {-0.55f, 0.761f, -0.1f});
        m_.material = glazes[2];
        m_.sphere({0.0f, 0.09f, 0.0f}, 0.09f, 24);

        m_.stand({-2.3f, 0, 0.6f}, 30.0f);
        m_.material = glazes[0];
        m_.box({-0.25f, 0, -0.25f}, {0.25f, 0.9f, 0.25f});
        m_.place = glm::translate(m_.place, {0.0f, 0.93f, 0.0f});
        add_knot(m_, 0.34f, 120, 12, brass);
        m_.stand({3.2f, 0, -2.2f});
        add_plant(m_, 1.4f, 30, dice, pot, leaf);
        m_.stand({2.9f, 0, 1.3f});
        m_.material = glazes[1];
        m_.sphere({0.0f, 0.4005f, 0.0f}, 0.4f, 36);
        m_.stand({2.2f, 0, 2.1f});
        m_.material = glazes[2];
        m_.sphere({0.0f, 0.2205f, 0.0f}, 0.22f, 28);
        m_.stand({-3.3f, 0, -0.9f});
        add_vase(m_, 0, 0.9f, 32, glazes[0]);
    }

    Scene scene_;
    Modeller m_;
};

/// Turns everything about an axis along which no coordinate vanishes.
void rotate(Scene& scene) {
    const glm::mat3 turn(glm::rotate(glm::mat4(1.0f), 0.83f, glm::normalize(glm::vec3(0.48f, 0.62f, -0.35f))));
    for (glm::vec3& p : scene.positions) p = turn * p;
    for (glm::vec3& n : scene.normals) n = turn * n;
    for (auto& light : scene.oriented) {
        light.position = turn * light.position;
        light.axis = glm::normalize(turn * light.axis);
    }
    for (Camera& camera : scene.cameras) {
        camera.eye = glm::dmat3(turn) * camera.eye;
        camera.target = glm::dmat3(turn) * camera.target;
        camera.up = turn * camera.up;
    }
}

}  // namespace

Scene builtin_surfaces(std::size_t lights, bool rotated) {
    Room room;
    room.add_lights(lights);
    Scene scene = room.scene();
    if (rotated) rotate(scene);
    return scene;
}

}  // namespace render
