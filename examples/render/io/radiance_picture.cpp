#include "io/radiance_picture.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>

#include <lightcuts/core/invalid_input.hpp>

#include "io/primaries.hpp"
#include "io/radiance_header.hpp"
#include "io/radiance_pixels.hpp"

namespace render {

namespace {

/// Luminance of a white of radiance 1, lm/W, in Radiance.
constexpr double white_efficacy = 179.0;

/// From stored numbers to radiance.
class Decoder {
public:
    explicit Decoder(const RadianceHeader& header)
        : is_xyz_(header.is_xyz), factor_(1.0 / header.exposure / (is_xyz_ ? white_efficacy : 1.0)),
          conversion_(is_xyz_ ? from_xyz(radiance_primaries) : to_rec709(header.primaries)) {
        for (std::size_t e = 1; e < scale_.size(); ++e) scale_[e] = std::ldexp(1.0, static_cast<int>(e) - 136);
    }

    glm::vec3 operator()(const Rgbe& pixel) const {
        glm::dvec3 color = scale_[pixel[3]] * glm::dvec3(pixel[0], pixel[1], pixel[2]);
        // A correction of colors was made in RGB, and so before a conversion to XYZ.
        if (!is_xyz_) color *= factor_;
        if (conversion_) color = (*conversion_)(color);
        if (is_xyz_) color *= factor_;
        return glm::vec3(color);
    }

private:
    bool is_xyz_;
    glm::dvec3 factor_;
    std::optional<ColorConversion> conversion_;
    std::array<double, 256> scale_{};  ///< by exponent; 0 is black
};

Picture decoded(std::string_view bytes) {
    const RadianceHeader header = radiance_header(bytes);
    const Decoder decode(header);
    const auto length = static_cast<std::size_t>(header.scanline_length());
    const std::vector<Rgbe> stored = radiance_pixels(bytes.substr(header.size), length,
                                                     static_cast<std::size_t>(header.scanlines()));

    Picture picture(header.width, header.height);
    for (std::size_t i = 0; i < stored.size(); ++i) {
        const int scanline = static_cast<int>(i / length);
        const int along = static_cast<int>(i % length);
        const int column = header.by_columns ? scanline : along;
        const int row = header.by_columns ? along : scanline;
        const int x = header.from_right ? header.width - 1 - column : column;
        const int y = header.from_bottom ? header.height - 1 - row : row;
        picture.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(header.width) +
                       static_cast<std::size_t>(x)] = decode(stored[i]);
    }
    return picture;
}

}  // namespace

Picture radiance_picture(std::string_view bytes, const std::string& name) {
    try {
        return decoded(bytes);
    } catch (const std::runtime_error& problem) {
        throw lightcuts::invalid_input(name + ": not a Radiance picture that can be read (" + problem.what() +
                                       "); save it again as .hdr or .exr");
    }
}

}  // namespace render
