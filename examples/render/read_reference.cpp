#include "read_reference.hpp"

#include <string>

#include <lightcuts/core/invalid_input.hpp>

namespace render {

std::optional<Picture> read_reference(const Options& options) {
    if (options.reference.empty()) return std::nullopt;
    Picture reference = read_exr(options.reference);
    if (reference.width != options.width || reference.height != options.height) {
        throw lightcuts::invalid_input(options.reference.string() + ": is " + std::to_string(reference.width) + "x" +
                                       std::to_string(reference.height) + " pixels; give --size " +
                                       std::to_string(reference.width) + "x" + std::to_string(reference.height) +
                                       " or another reference");
    }
    return reference;
}

}  // namespace render
