#include "scenes/ornaments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/ext/matrix_transform.hpp>
#include <glm/vec3.hpp>

namespace render {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// Rings of `around` points, `ring(i, angle)` giving radius (x) and height (y) of ring i.
template <class Ring>
std::vector<glm::vec3> rings_of(int rings, int around, const Ring& ring) {
    std::vector<glm::vec3> points;
    points.reserve(static_cast<std::size_t>(rings) * static_cast<std::size_t>(around));
    for (int i = 0; i < rings; ++i) {
        for (int s = 0; s < around; ++s) {
            const float angle = 2.0f * pi * static_cast<float>(s) / static_cast<float>(around);
            const glm::vec2 p = ring(i, angle);
            points.emplace_back(p.x * std::cos(angle), p.y, -p.x * std::sin(angle));
        }
    }
    return points;
}

}  // namespace

void add_torus(Modeller& m, float radius, float pipe, int length_segments, int segments, std::uint32_t material) {
    m.material = material;
    std::vector<glm::vec3> path;
    for (int i = 0; i < length_segments; ++i) {
        const float angle = 2.0f * pi * static_cast<float>(i) / static_cast<float>(length_segments);
        path.emplace_back(radius * std::cos(angle), pipe, radius * std::sin(angle));
    }
    m.tube(path, pipe, segments, true);
}

void add_turned(Modeller& m, std::span<const glm::vec2> outline, float size, int segments, std::uint32_t material) {
    m.material = material;
    std::vector<glm::vec2> profile = smooth_profile(outline, std::max(2, segments / 12));
    profile.insert(profile.begin(), profile.front());
    profile.insert(profile.begin(), {0.0f, profile.front().y});
    for (glm::vec2& p : profile) p *= size;
    m.lathe(profile, segments);
}

void add_goblet(Modeller& m, float height, int segments, std::uint32_t metal) {
    constexpr std::array<glm::vec2, 14> outline{{{0.26f, 0.0f},
                                                 {0.26f, 0.02f},
                                                 {0.10f, 0.06f},
                                                 {0.04f, 0.14f},
                                                 {0.06f, 0.26f},
                                                 {0.035f, 0.40f},
                                                 {0.10f, 0.48f},
                                                 {0.26f, 0.62f},
                                                 {0.29f, 0.80f},
                                                 {0.27f, 1.0f},
                                                 {0.25f, 1.0f},
                                                 {0.26f, 0.80f},
                                                 {0.20f, 0.60f},
                                                 {0.0f, 0.52f}}};
    add_turned(m, outline, height, segments, metal);
}

void add_pawn(Modeller& m, float height, int segments, std::uint32_t material) {
    constexpr std::array<glm::vec2, 13> outline{{{0.28f, 0.0f},
                                                 {0.29f, 0.06f},
                                                 {0.24f, 0.11f},
                                                 {0.25f, 0.15f},
                                                 {0.15f, 0.24f},
                                                 {0.10f, 0.45f},
                                                 {0.10f, 0.60f},
                                                 {0.19f, 0.64f},
                                                 {0.12f, 0.68f},
                                                 {0.175f, 0.76f},
                                                 {0.185f, 0.85f},
                                                 {0.12f, 0.96f},
                                                 {0.0f, 1.0f}}};
    add_turned(m, outline, height, segments, material);
}

void add_fluted_column(Modeller& m, float radius, float height, int flutes, std::uint32_t stone) {
    m.material = stone;
    const float abacus = 0.34f * radius;
    const float echinus = 0.42f * radius;
    const float shaft = height - abacus - echinus;
    const float neck = 0.80f * radius;
    constexpr int rings = 10;
    constexpr int steps = 5;  // of a flute
    const auto shaft_ring = [&](int i, float angle) {
        // Rings are close together where the flutes run out.
        const float even = static_cast<float>(i) / static_cast<float>(rings - 1);
        const float t = 0.5f - 0.5f * std::cos(pi * even);
        const float body = radius - (radius - neck) * std::pow(t, 1.6f);
        const float end = std::clamp(14.0f * std::min(t, 1.0f - t), 0.0f, 1.0f);
        const float turns = angle / (2.0f * pi) * static_cast<float>(flutes);
        const float hollow = std::sin(pi * (turns - std::floor(turns)));
        return glm::vec2(body * (1.0f - 0.085f * end * hollow), t * shaft);
    };
    m.sleeve(rings_of(rings, flutes * steps, shaft_ring), flutes * steps);
    const std::array<glm::vec2, 9> capital{{{neck, shaft},
                                            {1.05f * neck, shaft + 0.04f * radius},
                                            {1.05f * neck, shaft + 0.04f * radius},
                                            {1.02f * neck, shaft + 0.08f * radius},
                                            {1.02f * neck, shaft + 0.08f * radius},
                                            {1.28f * neck, shaft + 0.24f * radius},
                                            {1.52f * neck, shaft + 0.36f * radius},
                                            {1.55f * neck, shaft + echinus},
                                            {0.0f, shaft + echinus}}};
    m.lathe(capital, 2 * flutes);
    const float half = 1.3f * radius;
    m.box({-half, height - abacus, -half}, {half, height, half});
}

void add_triglyph(Modeller& m, float low, float height, std::uint32_t stone) {
    m.material = stone;
    for (const float x : {-0.17f, 0.0f, 0.17f}) {
        m.box({x - 0.06f, low + 0.002f, -0.01f}, {x + 0.06f, low + height - 0.002f, 0.07f});
    }
    for (int i = 0; i < 6; ++i) {
        const float x = -0.20f + 0.08f * static_cast<float>(i);
        m.cylinder({x, low - 0.15f, 0.055f}, 0.022f, 0.06f, 10);
    }
}

void add_cypress(Modeller& m, float height, Dice& dice, std::uint32_t leaf) {
    m.material = leaf;
    constexpr int rings = 22;
    constexpr int around = 18;
    const auto ring = [&](int i, float) {
        const float t = (static_cast<float>(i) + 0.02f) / (rings - 1 + 0.04f);
        return glm::vec2(0.12f * height * std::pow(t, 0.35f) * (1.0f - t) * dice.uniform(1.1f, 1.9f), height * t);
    };
    m.sleeve(rings_of(rings, around, ring), around);
}

void add_statue(Modeller& m, float height, std::uint32_t plinth, std::uint32_t body) {
    const glm::mat4 outer = m.place;
    const float foot = 0.25f * height;
    const float h = height - foot;
    m.material = plinth;
    m.box({-0.25f * h, 0.0f, -0.22f * h}, {0.25f * h, 0.2f * foot, 0.22f * h});
    m.box({-0.21f * h, 0.2f * foot, -0.18f * h}, {0.21f * h, 0.88f * foot, 0.18f * h});
    m.box({-0.235f * h, 0.88f * foot, -0.205f * h}, {0.235f * h, foot, 0.205f * h});

    m.material = body;
    constexpr std::array<glm::vec2, 10> outline{{{0.155f, 0.0f},
                                                 {0.15f, 0.03f},
                                                 {0.125f, 0.25f},
                                                 {0.135f, 0.45f},
                                                 {0.105f, 0.58f},
                                                 {0.13f, 0.70f},
                                                 {0.135f, 0.78f},
                                                 {0.06f, 0.835f},
                                                 {0.042f, 0.85f},
                                                 {0.045f, 0.89f}}};
    const std::vector<glm::vec2> robe = smooth_profile(outline, 4);
    m.place = glm::scale(glm::translate(outer, {0.0f, foot, 0.0f}), glm::vec3(h, h, 0.72f * h));
    const auto robe_ring = [&](int i, float angle) {
        const glm::vec2 p = robe[static_cast<std::size_t>(i)];
        // Folds fall from the waist, and lie flat above it.
        const float fold = std::max(0.0f, 0.62f - p.y);
        const float wave = 0.6f * std::sin(13.0f * angle + 2.0f * p.y) + 0.4f * std::sin(7.0f * angle - 3.0f * p.y);
        return glm::vec2(p.x * (1.0f + 0.16f * fold * wave), p.y);
    };
    m.sleeve(rings_of(static_cast<int>(robe.size()), 72, robe_ring), 72);
    m.place = glm::translate(outer, {0.0f, foot, 0.0f});
    const std::array<glm::vec3, 5> right{{{0.12f * h, 0.77f * h, 0.0f},
                                          {0.165f * h, 0.68f * h, 0.01f * h},
                                          {0.175f * h, 0.58f * h, 0.02f * h},
                                          {0.14f * h, 0.52f * h, 0.08f * h},
                                          {0.07f * h, 0.53f * h, 0.125f * h}}};
    m.tube(right, 0.03f * h, 18, false);
    const std::array<glm::vec3, 5> left{{{-0.12f * h, 0.77f * h, 0.0f},
                                         {-0.17f * h, 0.70f * h, 0.03f * h},
                                         {-0.19f * h, 0.66f * h, 0.10f * h},
                                         {-0.19f * h, 0.74f * h, 0.17f * h},
                                         {-0.18f * h, 0.80f * h, 0.19f * h}}};
    m.tube(left, 0.028f * h, 18, false);
    for (const glm::vec3& hand : {right.back(), left.back()}) m.sphere(hand, 0.034f * h, 18);
    m.place = glm::scale(m.place, {1.0f, 1.25f, 1.05f});
    m.sphere({0.0f, 0.748f * h, 0.005f * h}, 0.058f * h, 30);
    m.sphere({0.0f, 0.775f * h, -0.035f * h}, 0.042f * h, 20);
    m.place = outer;
}

}  // namespace render
