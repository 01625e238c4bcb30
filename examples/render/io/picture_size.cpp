#include "io/picture_size.hpp"

#include <stdexcept>
#include <string>

namespace render {

void check_picture_size(std::int64_t width, std::int64_t height) {
    const std::string size = std::to_string(width) + " x " + std::to_string(height) + " pixels";
    if (width <= 0 || height <= 0) throw std::runtime_error("a size of " + size + " is none");
    if (width > max_picture_side || height > max_picture_side || width * height > max_picture_pixels) {
        throw std::runtime_error(size + " are more than the " + std::to_string(max_picture_pixels) + " (" +
                                 std::to_string(max_picture_side) + " a side) that are read");
    }
}

}  // namespace render
