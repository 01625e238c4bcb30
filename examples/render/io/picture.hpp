#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace render {

/// Linear radiance per pixel, rows from the top, with further channels of the same size.
struct Picture {
    /// One channel, named as in the file: `depth`, or `normal.X` for a layer of several.
    struct Channel {
        std::string name;
        std::vector<float> values;
    };

    int width = 0;
    int height = 0;
    std::vector<glm::vec3> pixels;
    std::vector<Channel> channels;

    Picture() = default;
    /// Black. pre: width, height > 0.
    Picture(int width, int height);

    std::size_t size() const { return pixels.size(); }

    /// Appends a channel of zeros. Invalidates references to channels.
    void add_channel(const std::string& name);

    /// The channel of that name, or null.
    const Channel* find(const std::string& name) const;
    Channel* find(const std::string& name);
};

/// An OpenEXR file of R, G, B and the channels as 32-bit floats, losslessly compressed.
std::vector<char> exr_bytes(const Picture& picture);

/// Writes `exr_bytes` in one step. throws: invalid_input with the path.
void write_exr(const std::filesystem::path& path, const Picture& picture);

/// Reads the color and all other channels of an OpenEXR file, as `exr_picture` does.
/// throws: invalid_input with the path when it cannot be read or has no color.
Picture read_exr(const std::filesystem::path& path);

/// Linear `colors` in [0, 1] as 8-bit sRGB: red, green and blue of each in turn.
std::vector<std::uint8_t> srgb_bytes(std::span<const glm::vec3> colors);

/// A PNG file of 8-bit sRGB colors; `colors` in [0, 1], rows from the top. throws: std::bad_alloc.
std::vector<char> png_bytes(int width, int height, const std::vector<glm::vec3>& colors);

/// The same of what `srgb_bytes` gives.
std::vector<char> png_bytes(int width, int height, std::span<const std::uint8_t> bytes);

/// Writes `png_bytes` in one step. throws: invalid_input with the path.
void write_png(const std::filesystem::path& path, int width, int height, const std::vector<glm::vec3>& colors);

/// How radiance becomes a color in [0, 1] before the sRGB curve: exposed, bright parts compressed per channel by
/// Reinhard's curve.
struct ToneCurve {
    double exposure = 0;
    double white = 1;  ///< exposed radiance that becomes 1
};

/// The curve with which the log-average luminance of `picture` becomes a middle gray of 0.18 and its 99.5th percentile
/// white. Black pixels count for neither, and for the average none that are a thousand times darker than the 80th
/// percentile.
ToneCurve tone_curve(const Picture& picture);

/// The pixels as colors in [0, 1]. Pictures that are to be compared need one curve.
std::vector<glm::vec3> tone_mapped(const Picture& picture, const ToneCurve& curve);

/// With the picture's own curve.
std::vector<glm::vec3> tone_mapped(const Picture& picture);

}  // namespace render
