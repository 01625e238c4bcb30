// A table of lights (--lights).

#include <map>

#include <render/io/light_table.hpp>

#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return feed(data, size, [](std::string_view bytes) {
        render::Scene scene;
        render::add_light_table("lights.csv", scene, render::MemoryFiles({{"lights.csv", std::string(bytes)}}));
    });
}
