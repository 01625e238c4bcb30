#include "io/map_picture.hpp"

#include <string>

#include <lightcuts/core/invalid_input.hpp>

#include "io/exr_picture.hpp"
#include "io/file_kind.hpp"
#include "io/radiance_picture.hpp"
#include "io/text_file.hpp"

namespace render {

Picture read_map(const std::filesystem::path& path) {
    using lightcuts::invalid_input;
    const std::string bytes = read_file(path);
    if (begins_as_radiance(bytes)) return radiance_picture(bytes, path.string());
    if (begins_as_openexr(bytes)) return exr_picture(bytes, path.string(), ExrUse::map);
    throw invalid_input(path.string() + ": not a map that can be read (" +
                        what_it_is(bytes, "it is neither OpenEXR nor Radiance") + "); give an .exr or .hdr picture");
}

}  // namespace render
