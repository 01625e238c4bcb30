#include "texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <memory>
#include <utility>

#include <stb_image.h>
#include <glm/common.hpp>
#include <lightcuts/core/invalid_input.hpp>

#include "text_file.hpp"

namespace render {
namespace {

/// The texel that index `i` means in a row or column of `size` texels.
int wrapped(int i, int size, Texture::Wrap wrap) {
    if (wrap == Texture::Wrap::clamp) return std::clamp(i, 0, size - 1);
    const int period = wrap == Texture::Wrap::mirror ? 2 * size : size;
    const int j = (i % period + period) % period;
    return j < size ? j : 2 * size - 1 - j;
}

/// `u` within a short range in which the texture means the same, so that huge coordinates stay representable.
float reduced(float u, Texture::Wrap wrap) {
    if (wrap == Texture::Wrap::clamp) return std::clamp(u, 0.0f, 1.0f);
    return wrap == Texture::Wrap::mirror ? u - 2.0f * std::floor(0.5f * u) : u - std::floor(u);
}

}  // namespace

glm::vec4 Texture::sample(glm::vec2 uv) const {
    const auto texel = [&](int i, int j) {
        return texels[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i)];
    };
    if (filter == Filter::nearest) {
        const auto nearest = [](float u, int size, Wrap wrap) {
            return wrapped(static_cast<int>(std::floor(reduced(u, wrap) * static_cast<float>(size))), size, wrap);
        };
        return texel(nearest(uv.x, width, wrap_u), nearest(uv.y, height, wrap_v));
    }
    const float x = reduced(uv.x, wrap_u) * static_cast<float>(width) - 0.5f;
    const float y = reduced(uv.y, wrap_v) * static_cast<float>(height) - 0.5f;
    const float x_floor = std::floor(x);
    const float y_floor = std::floor(y);
    const int x0 = wrapped(static_cast<int>(x_floor), width, wrap_u);
    const int x1 = wrapped(static_cast<int>(x_floor) + 1, width, wrap_u);
    const int y0 = wrapped(static_cast<int>(y_floor), height, wrap_v);
    const int y1 = wrapped(static_cast<int>(y_floor) + 1, height, wrap_v);
    return glm::mix(glm::mix(texel(x0, y0), texel(x1, y0), x - x_floor),
                    glm::mix(texel(x0, y1), texel(x1, y1), x - x_floor), y - y_floor);
}

float srgb_to_linear(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

Texture make_texture(std::string name, const EncodedImage& image, bool srgb) {
    const auto channels = static_cast<std::size_t>(std::max(image.channels, 0));
    const auto pixels = static_cast<std::size_t>(std::max(image.width, 0)) *
                        static_cast<std::size_t>(std::max(image.height, 0));
    if (pixels == 0) throw lightcuts::invalid_input("texture '" + name + "': the image is empty; replace it");
    if (channels < 1 || channels > 4 || (image.bits != 8 && image.bits != 16) ||
        image.bytes < pixels * channels * static_cast<std::size_t>(image.bits / 8)) {
        throw lightcuts::invalid_input("texture '" + name +
                                       "': pixels of an unknown layout; save it with 8 or 16 bits a channel");
    }
    std::array<float, 256> decoded{};
    for (std::size_t i = 0; i < decoded.size(); ++i) {
        const float value = static_cast<float>(i) / 255.0f;
        decoded[i] = srgb ? srgb_to_linear(value) : value;
    }
    const auto value = [&](std::size_t i, bool color) {
        if (image.bits == 8) { return color ? decoded[image.data[i]] : static_cast<float>(image.data[i]) / 255.0f; }
        std::uint16_t wide = 0;
        std::memcpy(&wide, image.data + 2 * i, 2);
        const float v = static_cast<float>(wide) / 65535.0f;
        return color && srgb ? srgb_to_linear(v) : v;
    };

    Texture texture;
    texture.name = std::move(name);
    texture.width = image.width;
    texture.height = image.height;
    texture.texels.resize(pixels);
    const bool grey = channels < 3;
    const bool has_alpha = channels == 2 || channels == 4;
    for (std::size_t p = 0; p < pixels; ++p) {
        const std::size_t i = p * channels;
        const float red = value(i, true);
        texture.texels[p] = {red, grey ? red : value(i + 1, true), grey ? red : value(i + 2, true),
                             has_alpha ? value(i + channels - 1, false) : 1.0f};
    }
    return texture;
}

Texture texture_of_bytes(std::string_view file, const std::string& name, bool srgb) {
    int width = 0;
    int height = 0;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(file.data()), static_cast<int>(file.size()), &width,
                              &height, &channels, 4),
        stbi_image_free);
    if (!pixels) {
        throw lightcuts::invalid_input(name + ": not an image that can be read (" + stbi_failure_reason() +
                                       "); save it as PNG or JPEG");
    }
    const std::size_t bytes = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4;
    return make_texture(name, {width, height, 4, 8, pixels.get(), bytes}, srgb);
}

Texture read_texture(const std::filesystem::path& path, bool srgb) {
    return texture_of_bytes(read_file(path), path.string(), srgb);
}

}  // namespace render
