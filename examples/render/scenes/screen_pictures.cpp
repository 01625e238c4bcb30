#include "scenes/screen_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <lightcuts/core/random.hpp>

namespace render {
namespace {

/// A liquid-crystal screen lets some of its lamp through everywhere.
constexpr float leak = 0.02f;
constexpr float brightness = 0.6f;

/// `color(p)` at the middle of every pixel: x from 0 to width / height, y from 0 to 1, from the upper left corner.
template <class Color>
Texture painted(std::string name, int width, int height, const Color& color) {
    Texture texture;
    texture.name = std::move(name);
    texture.width = width;
    texture.height = height;
    texture.wrap_u = texture.wrap_v = Texture::Wrap::clamp;
    texture.texels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const glm::vec2 p = (glm::vec2(x, y) + 0.5f) / static_cast<float>(height);
            texture.texels.emplace_back(glm::max(brightness * color(p), glm::vec3(leak)), 1.0f);
        }
    }
    return texture;
}

/// Height of the `layer`-th range of mountains at x, from the picture's upper edge.
float ridge(float x, int layer) {
    const auto k = static_cast<float>(layer);
    float y = 0.46f + 0.055f * k;
    float size = 0.075f;
    float waves = 3.1f + 1.3f * k;
    for (int octave = 0; octave < 6; ++octave) {
        y -= size * (1.0f - 2.0f * std::abs(std::sin(waves * x + 2.3f * k + 1.7f * static_cast<float>(octave))));
        size *= 0.48f;
        waves *= 2.07f;
    }
    return y;
}

glm::vec3 sky(const glm::vec2& p) {
    const glm::vec2 sun(0.88f, 0.40f);
    const float up = glm::clamp(1.0f - p.y / 0.55f, 0.0f, 1.0f);
    glm::vec3 color = glm::mix(glm::vec3(1.9f, 0.52f, 0.10f), glm::vec3(0.03f, 0.09f, 0.38f), std::pow(up, 0.6f));
    const float distance = glm::distance(p, sun);
    color += glm::vec3(1.4f, 0.6f, 0.14f) * std::exp(-5.0f * distance);
    color += glm::vec3(9.0f, 6.5f, 3.4f) * glm::smoothstep(0.058f, 0.05f, distance);
    // Bars of cloud, lit from below.
    const float wave = std::sin(7.0f * p.x + 26.0f * p.y) + std::sin(-3.0f * p.x + 43.0f * p.y + 1.0f);
    const float cloud = glm::smoothstep(0.7f, 1.7f, wave) * glm::smoothstep(0.03f, 0.14f, p.y) *
                        glm::smoothstep(0.42f, 0.3f, p.y);
    return glm::mix(color, glm::vec3(1.5f, 0.32f, 0.20f), 0.6f * cloud);
}

glm::vec3 landscape(const glm::vec2& p) {
    constexpr std::array ranges{glm::vec3(0.30f, 0.13f, 0.17f), glm::vec3(0.10f, 0.06f, 0.12f),
                                glm::vec3(0.03f, 0.03f, 0.06f)};
    glm::vec3 color = sky(p);
    for (int layer = 0; layer < 3; ++layer) {
        if (p.y > ridge(p.x, layer)) color = ranges[static_cast<std::size_t>(layer)];
    }
    return color;
}

glm::vec3 dusk(const glm::vec2& p) {
    constexpr float shore = 0.62f;
    if (p.y < shore) return landscape(p);
    const float depth = p.y - shore;
    const float ripple = 0.012f * std::sin(180.0f * std::sqrt(depth) + 3.0f * std::sin(9.0f * p.x));
    const glm::vec2 mirrored(p.x + ripple * (0.3f + 4.0f * depth), shore - 1.35f * depth + ripple);
    return glm::vec3(0.62f, 0.66f, 0.74f) * landscape({mirrored.x, std::max(mirrored.y, 0.0f)});
}

glm::vec3 card(const glm::vec2& p) {
    constexpr float white = 2.4f;
    const glm::vec2 middle(2.0f / 3.0f, 0.5f);
    const float distance = glm::distance(p, middle);
    const bool inside = distance < 0.42f;
    if (std::abs(distance - 0.42f) < 0.006f) return glm::vec3(white);
    const float x = 0.75f * p.x;  // 0 to 1
    if (!inside) {
        const glm::vec2 cell = glm::fract(p * 12.0f);
        const bool line = std::min(cell.x, cell.y) < 0.07f;
        return line ? glm::vec3(0.5f * white) : glm::vec3(0.035f, 0.04f, 0.05f) * white;
    }
    if (p.y < 0.42f) {  // bars: white, yellow, cyan, green, magenta, red, blue
        const int bar = std::clamp(static_cast<int>((p.x - middle.x + 0.42f) / 0.84f * 7.0f), 0, 6);
        constexpr std::array<std::uint32_t, 7> bits{7, 6, 3, 2, 5, 4, 1};
        const std::uint32_t b = bits[static_cast<std::size_t>(bar)];
        return white * glm::vec3((b & 4u) != 0, (b & 2u) != 0, (b & 1u) != 0);
    }
    if (p.y < 0.56f) {  // ever finer lines
        return std::sin(40.0f * std::exp(2.2f * x)) > 0.0f ? glm::vec3(white) : glm::vec3(0.0f);
    }
    if (p.y < 0.70f) return glm::vec3(white * std::floor(10.0f * (p.x - 0.24f) / 0.84f) / 9.0f);
    const glm::vec3 warm(1.0f, 0.45f, 0.08f);
    const glm::vec3 cool(0.08f, 0.35f, 1.0f);
    return white * glm::mix(cool, warm, glm::smoothstep(0.35f, 0.95f, p.x));
}

}  // namespace

Texture dusk_picture(int width, int height) { return painted("dusk", width, height, dusk); }

Texture test_card(int width, int height) { return painted("test card", width, height, card); }

}  // namespace render
