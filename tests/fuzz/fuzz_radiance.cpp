// A Radiance picture (.hdr).

#include <render/io/radiance_picture.hpp>

#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return feed(data, size, [](std::string_view bytes) { render::radiance_picture(bytes, "p.hdr"); });
}
