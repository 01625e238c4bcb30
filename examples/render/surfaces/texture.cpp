#include "surfaces/texture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <utility>

#include <stb_image.h>
#include <glm/common.hpp>
#include <lightcuts/core/invalid_input.hpp>

#include "io/escape.hpp"
#include "io/exr_picture.hpp"
#include "io/file_kind.hpp"
#include "io/picture_size.hpp"
#include "io/radiance_picture.hpp"
#include "io/text_file.hpp"

namespace render {
namespace {

/// `u` within a short range in which the texture means the same, so that huge coordinates stay representable.
float reduced(float u, Texture::Wrap wrap) {
    if (wrap == Texture::Wrap::clamp) return std::clamp(u, 0.0f, 1.0f);
    return wrap == Texture::Wrap::mirror ? u - 2.0f * std::floor(0.5f * u) : u - std::floor(u);
}

/// A texture of linear colors.
Texture texture_of_picture(const Picture& picture, const std::string& name, Premultiplication premultiplication) {
    const Picture::Channel* alpha = picture.find("A");
    Texture texture;
    texture.name = name;
    texture.width = picture.width;
    texture.height = picture.height;
    texture.texels.reserve(picture.size());
    for (std::size_t i = 0; i < picture.size(); ++i) {
        const float a = alpha ? alpha->values[i] : 1.0f;
        const bool undo = premultiplication == Premultiplication::undo && a > 0.0f && a < 1.0f;
        const glm::vec3 color = undo ? picture.pixels[i] / a : picture.pixels[i];
        const glm::vec4 texel(color, a);
        for (int c = 0; c < 4; ++c) {
            if (std::isfinite(texel[c]) && texel[c] >= 0.0f) continue;
            const std::size_t width = static_cast<std::size_t>(picture.width);
            throw lightcuts::invalid_input(name + ": pixel (" + std::to_string(i % width) + ", " +
                                           std::to_string(i / width) + ") is negative or not finite; correct it");
        }
        texture.texels.emplace_back(color, std::min(a, 1.0f));
    }
    return texture;
}

/// Bytes of a picture, which remember whether more were wanted than there are: stb_image goes on with zeros then.
struct StbBytes {
    std::string_view left;
    bool ran_out = false;

    static int read(void* self, char* to, int wanted) {
        // stb_image fills a buffer of this size in advance, but asks for what it needs otherwise.
        constexpr int in_advance = 128;
        StbBytes& bytes = *static_cast<StbBytes*>(self);
        const std::size_t count = std::min(bytes.left.size(), static_cast<std::size_t>(wanted));
        bytes.ran_out = bytes.ran_out || count == 0 || (static_cast<int>(count) < wanted && wanted != in_advance);
        if (count > 0) std::memcpy(to, bytes.left.data(), count);
        bytes.left.remove_prefix(count);
        return static_cast<int>(count);
    }
    static void skip(void* self, int count) {
        StbBytes& bytes = *static_cast<StbBytes*>(self);
        bytes.left.remove_prefix(std::min(bytes.left.size(), static_cast<std::size_t>(std::max(count, 0))));
    }
    static int is_at_end(void* self) { return static_cast<StbBytes*>(self)->left.empty() ? 1 : 0; }
};

constexpr stbi_io_callbacks stb_callbacks{&StbBytes::read, &StbBytes::skip, &StbBytes::is_at_end};

/// Whether stb_image reads files of this kind, as `file_kind` names it. It also reads TGA, which no bytes tell.
bool is_read_by_stb(std::string_view kind) {
    constexpr std::string_view kinds[] = {"",
                                          "a PNG picture",
                                          "a JPEG picture",
                                          "a BMP picture",
                                          "a GIF picture",
                                          "a Photoshop file",
                                          "a PGM picture",
                                          "a PPM picture"};
    return std::find(std::begin(kinds), std::end(kinds), kind) != std::end(kinds);
}

/// A texture of a picture of 8 or 16 bits a channel.
Texture decoded_texture(std::string_view bytes, const std::string& name, bool srgb) {
    const auto fail = [&](const std::string& problem) {
        throw lightcuts::invalid_input(name + ": not an image that can be read (" + problem +
                                       "); save it as PNG or JPEG");
    };
    const std::string_view kind = file_kind(bytes);
    if (!is_read_by_stb(kind)) {
        throw lightcuts::invalid_input(name + ": is " + std::string(kind) +
                                       ", which cannot be read; convert it to PNG");
    }
    if (bytes.empty()) fail("it is empty");

    int width = 0;
    int height = 0;
    int channels = 0;
    StbBytes header{bytes};
    if (stbi_info_from_callbacks(&stb_callbacks, &header, &width, &height, &channels) != 0) {
        try {
            check_picture_size(width, height);
        } catch (const std::runtime_error& problem) { fail(problem.what()); }
    }

    StbBytes depth{bytes};
    const bool is_wide = stbi_is_16_bit_from_callbacks(&stb_callbacks, &depth) != 0;
    StbBytes all{bytes};
    const std::unique_ptr<void, void (*)(void*)> pixels(
        is_wide ? static_cast<void*>(stbi_load_16_from_callbacks(&stb_callbacks, &all, &width, &height, &channels, 4))
                : static_cast<void*>(stbi_load_from_callbacks(&stb_callbacks, &all, &width, &height, &channels, 4)),
        stbi_image_free);
    if (all.ran_out && (pixels || !kind.empty())) fail("it is cut short");
    if (!pixels) fail(excerpt(stbi_failure_reason()));
    const int bits = is_wide ? 16 : 8;
    const std::size_t size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4 *
                             static_cast<std::size_t>(bits / 8);
    return make_texture(name, {width, height, 4, bits, static_cast<const std::uint8_t*>(pixels.get()), size}, srgb);
}

}  // namespace

int wrapped_texel(int i, int size, Texture::Wrap wrap) {
    if (wrap == Texture::Wrap::clamp) return std::clamp(i, 0, size - 1);
    const int period = wrap == Texture::Wrap::mirror ? 2 * size : size;
    const int j = (i % period + period) % period;
    return j < size ? j : 2 * size - 1 - j;
}

glm::vec4 Texture::sample(glm::vec2 uv) const {
    const auto texel = [&](int i, int j) {
        return texels[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i)];
    };
    if (filter == Filter::nearest) {
        const auto nearest = [](float u, int size, Wrap wrap) {
            return wrapped_texel(static_cast<int>(std::floor(reduced(u, wrap) * static_cast<float>(size))), size, wrap);
        };
        return texel(nearest(uv.x, width, wrap_u), nearest(uv.y, height, wrap_v));
    }
    const float x = reduced(uv.x, wrap_u) * static_cast<float>(width) - 0.5f;
    const float y = reduced(uv.y, wrap_v) * static_cast<float>(height) - 0.5f;
    const float x_floor = std::floor(x);
    const float y_floor = std::floor(y);
    const int x0 = wrapped_texel(static_cast<int>(x_floor), width, wrap_u);
    const int x1 = wrapped_texel(static_cast<int>(x_floor) + 1, width, wrap_u);
    const int y0 = wrapped_texel(static_cast<int>(y_floor), height, wrap_v);
    const int y1 = wrapped_texel(static_cast<int>(y_floor) + 1, height, wrap_v);
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
    const bool gray = channels < 3;
    const bool has_alpha = channels == 2 || channels == 4;
    for (std::size_t p = 0; p < pixels; ++p) {
        const std::size_t i = p * channels;
        const float red = value(i, true);
        texture.texels[p] = {red, gray ? red : value(i + 1, true), gray ? red : value(i + 2, true),
                             has_alpha ? value(i + channels - 1, false) : 1.0f};
    }
    return texture;
}

Texture texture_of_bytes(std::string_view bytes, const std::string& name, bool srgb,
                         Premultiplication premultiplication) {
    if (begins_as_radiance(bytes)) {
        return texture_of_picture(radiance_picture(bytes, name), name, premultiplication);
    }
    if (begins_as_openexr(bytes)) {
        return texture_of_picture(exr_picture(bytes, name, ExrUse::texture), name, premultiplication);
    }
    return decoded_texture(bytes, name, srgb);
}

}  // namespace render
