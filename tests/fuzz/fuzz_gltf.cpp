// A glTF file, .gltf or .glb, with all of its data in it: as it stands, and in motion.

#include <map>

#include <render/io/load_gltf.hpp>
#include <render/io/validate.hpp>

#include "fuzz_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return feed(data, size, [](std::string_view bytes) {
        const render::MemoryFiles files({{"s", std::string(bytes)}});
        for (const render::Shutter& shutter : {render::Shutter{}, render::Shutter{.opens = 0.25, .seconds = 1.0}}) {
            render::Scene scene = render::load_gltf("s", files, shutter);
            render::validate(scene);
        }
    });
}
