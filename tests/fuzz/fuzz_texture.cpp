// An image as a texture: PNG, JPEG, TGA, BMP, Radiance or OpenEXR.

#include <render/surfaces/texture.hpp>

#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return feed(data, size, [](std::string_view bytes) { render::texture_of_bytes(bytes, "t.png", true); });
}
