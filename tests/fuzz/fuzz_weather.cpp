// An EnergyPlus weather file (EPW).

#include <daylight/weather.hpp>

#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return feed(data, size, [](std::string_view text) { daylighting::epw_weather(text, "p.epw"); });
}
