#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <string>

/// A sky matrix as gendaymtx writes it. `radiance(patch, hour, channel)`.
inline std::string sky_matrix_text(std::size_t patches, std::size_t hours, const std::string& format,
                                   const std::function<double(std::size_t, std::size_t, int)>& radiance,
                                   bool high_byte_first = false) {
    std::string text = "#?RADIANCE\ngendaymtx -s -m 1 madeup.wea\nLATLONG= 48.20000000 16.37000000\nNROWS=" +
                       std::to_string(patches) + "\nNCOLS=" + std::to_string(hours) + "\nNCOMP=3\n";
    if (format != "ascii") text += std::string("BigEndian=") + (high_byte_first ? "1" : "0") + "\n";
    text += "FORMAT=" + format + (format == "ascii" ? "" : "   ") + "\n\n";
    const auto add = [&](auto word) {
        std::string bytes;
        for (std::size_t i = 0; i < sizeof word; ++i) bytes.push_back(static_cast<char>((word >> (8 * i)) & 0xff));
        if (high_byte_first) std::reverse(bytes.begin(), bytes.end());
        text += bytes;
    };
    for (std::size_t patch = 0; patch < patches; ++patch) {
        for (std::size_t hour = 0; hour < hours; ++hour) {
            for (int c = 0; c < 3; ++c) {
                const double value = radiance(patch, hour, c);
                if (format == "ascii") {
                    char number[40];
                    std::snprintf(number, sizeof number, "%.17g%s", value, c < 2 ? " " : "\n");
                    text += number;
                } else if (format == "float") {
                    add(std::bit_cast<std::uint32_t>(static_cast<float>(value)));
                } else {
                    add(std::bit_cast<std::uint64_t>(value));
                }
            }
        }
        if (format == "ascii" && hours > 1) text += "\n";
    }
    return text;
}
