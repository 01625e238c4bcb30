// A sky matrix (.smx). What is read has to be of finite luminances that are not negative.

#include <cmath>

#include <daylight/sky_matrix.hpp>

#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return feed(data, size, [](std::string_view bytes) {
        for (const float luminance : daylighting::sky_matrix(bytes, "p.smx").luminances) {
            if (!(std::isfinite(luminance) && luminance >= 0.0f)) std::terminate();
        }
    });
}
