// A glTF file, .gltf or .glb, with all of its data in it.

#include <map>

#include <render/io/load_gltf.hpp>
#include <render/io/validate.hpp>

#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return feed(data, size, [](std::string_view bytes) {
        render::Scene scene = render::load_gltf("s", render::MemoryFiles({{"s", std::string(bytes)}}));
        render::validate(scene);
    });
}
