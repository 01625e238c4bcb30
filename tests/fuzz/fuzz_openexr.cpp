// An OpenEXR picture, for each of its uses.

#include <render/io/exr_picture.hpp>

#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using render::ExrUse;
    for (const ExrUse use : {ExrUse::picture, ExrUse::map, ExrUse::texture}) {
        if (feed(data, size, [use](std::string_view bytes) { render::exr_picture(bytes, "p.exr", use); }) != 0)
            return -1;
    }
    return 0;
}
