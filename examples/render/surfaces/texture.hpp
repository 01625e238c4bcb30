#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "scene.hpp"

namespace render {

/// The light that an sRGB-encoded value in [0, 1] stands for.
float srgb_to_linear(float encoded);

/// Pixels as an image decoder delivers them: rows from the top, channels interleaved.
struct EncodedImage {
    int width = 0;
    int height = 0;
    int channels = 4;  ///< 1: gray; 2: gray, alpha; 3: RGB; 4: RGBA
    int bits = 8;      ///< a channel: 8 or 16
    const std::uint8_t* data = nullptr;
    std::size_t bytes = 0;
};

/// A texture of `image`. `srgb`: its colors (never its alpha) are sRGB-encoded.
/// throws: invalid_input naming `name` when the pixels are missing or of an unknown layout.
Texture make_texture(std::string name, const EncodedImage& image, bool srgb);

/// The texel that index `i` means in a row or column of `size` texels: what is outside wraps.
int wrapped_texel(int i, int size, Texture::Wrap wrap);

/// What becomes of colors that a picture holds times its alpha, as OpenEXR does. A surface's are multiplied by its
/// opacity when they are seen; emitted radiance is stored as it is seen.
enum class Premultiplication { undo, keep };

/// A texture of a picture's file, by what it holds: PNG (8 or 16 bits a channel), JPEG, TGA, BMP; Radiance and OpenEXR,
/// whose colors are linear, of any brightness, and never sRGB-encoded. `name`: for messages, and the texture's.
/// throws: invalid_input, one line: of another kind, damaged, cut short, too large, or with the first pixel that is
/// negative or not finite.
Texture texture_of_bytes(std::string_view bytes, const std::string& name, bool srgb,
                         Premultiplication premultiplication = Premultiplication::undo);

}  // namespace render
