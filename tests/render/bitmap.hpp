#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// A BMP picture of one row.
inline std::string bitmap(const std::vector<std::array<std::uint8_t, 3>>& rgb) {
    std::string file = "BM";
    const auto add = [&](std::size_t bytes, std::size_t value) {  // little-endian
        for (std::size_t i = 0; i < bytes; ++i) file += static_cast<char>(value >> (8 * i) & 255);
    };
    const std::size_t row = (3 * rgb.size() + 3) / 4 * 4;
    for (const std::size_t field : {54 + row, std::size_t(0), std::size_t(54), std::size_t(40), rgb.size()})
        add(4, field);
    add(4, 1);
    add(2, 1);
    add(2, 24);
    for (const std::size_t field : {std::size_t(0), row, std::size_t(2835), std::size_t(2835)}) add(4, field);
    add(8, 0);
    for (const auto& [r, g, b] : rgb) file += {static_cast<char>(b), static_cast<char>(g), static_cast<char>(r)};
    file.resize(54 + row, '\0');
    return file;
}
