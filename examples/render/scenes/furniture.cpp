#include "scenes/furniture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>

namespace render {
namespace {

constexpr float two_pi = 2.0f * std::numbers::pi_v<float>;

/// A vessel with a flat base and a hollow at its mouth.
std::vector<glm::vec2> vessel(std::span<const glm::vec2> outline, float height, int steps) {
    std::vector<glm::vec2> outer = smooth_profile(outline, steps);
    for (glm::vec2& p : outer) p *= height;
    std::vector<glm::vec2> profile{{0.0f, outer.front().y}, outer.front()};
    profile.insert(profile.end(), outer.begin(), outer.end());
    const glm::vec2 rim = outer.back();
    const float neck = 0.82f * rim.x;
    profile.push_back(rim);
    profile.emplace_back(neck, rim.y);
    profile.emplace_back(neck, rim.y);
    profile.emplace_back(neck, rim.y - 0.25f * height);
    profile.emplace_back(0.0f, rim.y - 0.3f * height);
    return profile;
}

}  // namespace

void add_table(Modeller& m, float length, float width, std::uint32_t top, std::uint32_t legs) {
    const float x = 0.5f * length;
    const float z = 0.5f * width;
    m.material = top;
    m.box({-x, 0.72f, -z}, {x, 0.76f, z});
    m.material = legs;
    m.box({-x + 0.08f, 0.62f, -z + 0.08f}, {x - 0.08f, 0.718f, -z + 0.11f});
    m.box({-x + 0.08f, 0.62f, z - 0.11f}, {x - 0.08f, 0.718f, z - 0.08f});
    const glm::mat4 outer = m.place;
    const std::array<glm::vec2, 9> leg{{{0.0f, 0.0f},
                                        {0.022f, 0.0f},
                                        {0.022f, 0.0f},
                                        {0.026f, 0.12f},
                                        {0.042f, 0.3f},
                                        {0.03f, 0.5f},
                                        {0.04f, 0.62f},
                                        {0.04f, 0.719f},
                                        {0.0f, 0.719f}}};
    for (const float sx : {-1.0f, 1.0f}) {
        for (const float sz : {-1.0f, 1.0f}) {
            m.place = glm::translate(outer, {sx * (x - 0.12f), 0.0f, sz * (z - 0.12f)});
            m.lathe(leg, 12);
        }
    }
    m.place = outer;
}

void add_chair(Modeller& m, std::uint32_t wood, std::uint32_t seat) {
    m.material = wood;
    for (const float x : {-0.2f, 0.17f}) {
        m.box({x, 0.0f, 0.17f}, {x + 0.03f, 0.43f, 0.2f});
        m.box({x, 0.0f, -0.2f}, {x + 0.03f, 0.92f, -0.17f});
    }
    m.box({-0.2f, 0.84f, -0.195f}, {0.2f, 0.92f, -0.175f});
    m.box({-0.2f, 0.62f, -0.193f}, {0.2f, 0.66f, -0.177f});
    for (const float x : {-0.1f, 0.0f, 0.1f}) m.box({x - 0.012f, 0.66f, -0.19f}, {x + 0.012f, 0.84f, -0.18f});
    m.box({-0.21f, 0.405f, -0.21f}, {0.21f, 0.43f, 0.22f});
    m.material = seat;
    const std::array<glm::vec2, 6> cushion{
        {{0.0f, 0.431f}, {0.2f, 0.431f}, {0.215f, 0.447f}, {0.2f, 0.466f}, {0.15f, 0.474f}, {0.0f, 0.478f}}};
    m.lathe(cushion, 16);
}

void add_vase(Modeller& m, int style, float height, int segments, std::uint32_t glaze) {
    m.material = glaze;
    const int steps = std::max(2, segments / 8);
    if (style == 0) {
        const std::array<glm::vec2, 7> amphora{{{0.13f, 0.0f},
                                                {0.15f, 0.04f},
                                                {0.27f, 0.35f},
                                                {0.26f, 0.6f},
                                                {0.11f, 0.82f},
                                                {0.1f, 0.92f},
                                                {0.16f, 1.0f}}};
        m.lathe(vessel(amphora, height, steps), segments);
    } else if (style == 1) {
        const std::array<glm::vec2, 6> bottle{
            {{0.17f, 0.0f}, {0.22f, 0.06f}, {0.2f, 0.3f}, {0.07f, 0.58f}, {0.06f, 0.9f}, {0.09f, 1.0f}}};
        m.lathe(vessel(bottle, height, steps), segments);
    } else {
        const std::array<glm::vec2, 6> jar{
            {{0.22f, 0.0f}, {0.3f, 0.1f}, {0.42f, 0.5f}, {0.38f, 0.78f}, {0.26f, 0.93f}, {0.28f, 1.0f}}};
        m.lathe(vessel(jar, height, steps), segments);
    }
}

void add_column(Modeller& m, float radius, float height, int segments, std::uint32_t stone) {
    m.material = stone;
    const float plinth = 1.5f * radius;
    m.box({-plinth, 0.0f, -plinth}, {plinth, 0.35f * radius, plinth});
    m.box({-plinth, height - 0.35f * radius, -plinth}, {plinth, height, plinth});
    const float low = 0.351f * radius;
    const float high = height - low;
    const float r = radius;
    const std::array<glm::vec2, 18> profile{{{0.0f, low},
                                             {1.4f * r, low},
                                             {1.4f * r, low},
                                             {1.46f * r, low + 0.15f * r},
                                             {1.4f * r, low + 0.3f * r},
                                             {1.2f * r, low + 0.38f * r},
                                             {1.24f * r, low + 0.55f * r},
                                             {1.04f * r, low + 0.66f * r},
                                             {1.04f * r, low + 0.66f * r},
                                             {r, low + 0.33f * (high - low)},
                                             {0.86f * r, high - 0.9f * r},
                                             {0.86f * r, high - 0.9f * r},
                                             {1.0f * r, high - 0.82f * r},
                                             {0.9f * r, high - 0.7f * r},
                                             {1.05f * r, high - 0.5f * r},
                                             {1.42f * r, high - 0.12f * r},
                                             {1.42f * r, high},
                                             {0.0f, high}}};
    m.lathe(profile, segments);
}

void add_plant(Modeller& m, float size, int leaves, Dice& dice, std::uint32_t pot, std::uint32_t leaf) {
    const glm::mat4 outer = m.place;
    m.material = pot;
    const float r = 0.2f * size;
    const std::array<glm::vec2, 9> profile{{{0.0f, 0.0f},
                                            {0.7f * r, 0.0f},
                                            {0.7f * r, 0.0f},
                                            {0.95f * r, 0.8f * r},
                                            {1.05f * r, 1.5f * r},
                                            {1.15f * r, 1.6f * r},
                                            {1.05f * r, 1.68f * r},
                                            {0.95f * r, 1.6f * r},
                                            {0.0f, 1.5f * r}}};
    m.lathe(profile, 20);
    m.material = leaf;
    for (int i = 0; i < leaves; ++i) {
        const float t = (static_cast<float>(i) + 0.5f) / static_cast<float>(leaves);
        const float angle = 2.399963f * static_cast<float>(i) + dice.uniform(-0.2f, 0.2f);
        const float reach = size * (0.2f + 0.4f * t) * dice.uniform(0.85f, 1.15f);
        const float rise = size * (1.25f - 0.75f * t) * dice.uniform(0.85f, 1.15f);
        const glm::vec3 root(0.3f * r * std::cos(angle), 1.5f * r, 0.3f * r * std::sin(angle));
        const glm::vec3 tip(reach * std::cos(angle), 1.5f * r + rise, reach * std::sin(angle));
        m.blade(root, tip, 0.16f * size, size * (0.1f + 0.35f * t), 6);
    }
    m.place = outer;
}

void add_book_stack(Modeller& m, int count, Dice& dice, std::span<const std::uint32_t> covers) {
    const glm::mat4 outer = m.place;
    float y = 0.0f;
    for (int i = 0; i < count; ++i) {
        const float thick = dice.uniform(0.02f, 0.045f);
        const float x = dice.uniform(0.09f, 0.12f);
        const float z = dice.uniform(0.13f, 0.16f);
        m.place = glm::rotate(outer, dice.uniform(-0.35f, 0.35f), glm::vec3(0.0f, 1.0f, 0.0f));
        m.material = covers[dice.pick(covers.size())];
        m.box({-x, y, -z}, {x, y + thick, z});
        y += thick + 0.001f;
    }
    m.place = outer;
}

void add_bookcase(Modeller& m, float width, float height, int shelves, Dice& dice, std::uint32_t wood,
                  std::span<const std::uint32_t> covers) {
    const glm::mat4 outer = m.place;
    const float x = 0.5f * width;
    const float depth = 0.34f;
    const float board = 0.03f;
    m.material = wood;
    m.box({-x, 0.0f, 0.0f}, {x, height, 0.02f});
    m.box({-x, 0.0f, 0.02f}, {-x + board, height, depth});
    m.box({x - board, 0.0f, 0.02f}, {x, height, depth});
    m.box({-x - 0.03f, height, 0.0f}, {x + 0.03f, height + 0.05f, depth + 0.03f});
    const float room = (height - 0.1f) / static_cast<float>(shelves);
    for (int s = 0; s < shelves; ++s) {
        const float y = 0.1f + static_cast<float>(s) * room;
        m.material = wood;
        m.box({-x + board, y - board, 0.02f}, {x - board, y, depth - 0.01f});
        float at = -x + board + 0.01f;
        while (true) {
            const float thick = dice.uniform(0.027f, 0.07f);
            const float tall = room * dice.uniform(0.6f, 0.86f);
            const float deep = dice.uniform(0.2f, 0.27f);
            const bool gap = dice.uniform(0.0f, 1.0f) < 0.06f;
            if (at + thick > x - board - 0.01f) break;
            if (!gap) {
                m.material = covers[dice.pick(covers.size())];
                m.box({at, y + 0.001f, 0.04f}, {at + thick - 0.002f, y + tall, 0.04f + deep});
            }
            at += gap ? 2.5f * thick : thick;
        }
    }
    m.place = outer;
}

void add_knot(Modeller& m, float size, int length_segments, int segments, std::uint32_t metal) {
    m.material = metal;
    std::vector<glm::vec3> path;
    const float pipe = 0.16f * size;
    for (int i = 0; i < length_segments; ++i) {
        const float t = two_pi * static_cast<float>(i) / static_cast<float>(length_segments);
        const float r = size * (0.6f + 0.24f * std::cos(3.0f * t));
        path.emplace_back(r * std::cos(2.0f * t), size + r * std::sin(2.0f * t), 0.3f * size * std::sin(3.0f * t));
    }
    m.tube(path, pipe, segments, true);
}

}  // namespace render
