// A scene.json.

#include <map>

#include <render/io/scene_description.hpp>

#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return feed(data, size, [](std::string_view bytes) {
        render::read_scene_description("scene.json", render::MemoryFiles({{"scene.json", std::string(bytes)}}));
    });
}
