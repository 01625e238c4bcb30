#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

/// Three mantissas and an exponent.
using Rgbe = std::array<std::uint8_t, 4>;
using Scanline = std::vector<Rgbe>;

/// The pixel nearest to a color without negative channels.
inline Rgbe rgbe_of(const glm::dvec3& color) {
    const double most = std::max({color.r, color.g, color.b});
    if (!(most > 0.0)) return {0, 0, 0, 0};
    int exponent = 0;
    std::frexp(most, &exponent);
    // A mantissa that is rounded up to 256 needs the next exponent.
    if (std::lround(std::ldexp(most, 8 - exponent)) > 255) ++exponent;
    const auto mantissa = [&](double v) { return static_cast<std::uint8_t>(std::lround(std::ldexp(v, 8 - exponent))); };
    return {mantissa(color.r), mantissa(color.g), mantissa(color.b), static_cast<std::uint8_t>(exponent + 128)};
}

inline std::string bytes_of(const Rgbe& pixel) { return {pixel.begin(), pixel.end()}; }

/// Pixel by pixel.
inline std::string flat(const Scanline& line) {
    std::string bytes;
    for (const Rgbe& pixel : line) bytes += bytes_of(pixel);
    return bytes;
}

/// With repeat counts 1, 1, 1, n, the lowest byte first.
inline std::string old_encoded(const Scanline& line) {
    std::string bytes;
    for (std::size_t i = 0; i < line.size();) {
        std::size_t end = i + 1;
        while (end < line.size() && line[end] == line[i]) ++end;
        bytes += bytes_of(line[i]);
        for (std::size_t repeats = end - i - 1; repeats > 0; repeats >>= 8) {
            bytes += bytes_of({1, 1, 1, static_cast<std::uint8_t>(repeats & 255)});
        }
        i = end;
    }
    return bytes;
}

/// Channel by channel, with runs of three and more. pre: 8 to 32767 pixels.
inline std::string new_encoded(const Scanline& line) {
    std::string bytes = bytes_of(
        {2, 2, static_cast<std::uint8_t>(line.size() >> 8), static_cast<std::uint8_t>(line.size() & 255)});
    for (std::size_t channel = 0; channel < 4; ++channel) {
        const auto at = [&](std::size_t i) { return line[i][channel]; };
        const auto run = [&](std::size_t i) {
            std::size_t end = i + 1;
            while (end < line.size() && end - i < 127 && at(end) == at(i)) ++end;
            return end - i;
        };
        for (std::size_t i = 0; i < line.size();) {
            if (const std::size_t count = run(i); count >= 3) {
                bytes += static_cast<char>(128 + count);
                bytes += static_cast<char>(at(i));
                i += count;
                continue;
            }
            std::size_t end = i;
            while (end < line.size() && end - i < 128 && run(end) < 3) ++end;
            bytes += static_cast<char>(end - i);
            for (; i < end; ++i) bytes += static_cast<char>(at(i));
        }
    }
    return bytes;
}

/// A file: `lines` of the header each with its end, the resolution line without, and the scanlines.
inline std::string radiance_file(const std::string& lines, const std::string& resolution, const std::string& pixels) {
    return "#?RADIANCE\n" + lines + "\n" + resolution + "\n" + pixels;
}
