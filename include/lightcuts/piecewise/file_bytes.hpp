#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <ios>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "../core/invalid_input.hpp"

namespace lightcuts {

/// All bytes of a file. throws: invalid_input naming the file if it cannot be read.
inline std::vector<std::byte> read_bytes(const std::filesystem::path& path) {
    const auto refuse = [&](const char* problem) { LIGHTCUTS_THROW(invalid_input(path.string() + ": " + problem)); };
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) refuse("is not a file that can be read");
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) refuse("cannot be opened");
    std::vector<std::byte> bytes(static_cast<std::size_t>(file.tellg()));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!file || file.gcount() != static_cast<std::streamsize>(bytes.size())) refuse("cannot be read to its end");
    return bytes;
}

/// Makes `bytes` the content of a file: in one step, so that whatever happens there is the old file or the new one.
/// They are written to a file beside it first, which is removed if that fails.
/// throws: invalid_input naming the file if it cannot be written.
inline void write_bytes(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    std::filesystem::path temporary = path;
    temporary += "." + std::to_string(std::random_device{}()) + ".part";
    std::error_code error;
    const auto refuse = [&](const std::string& problem) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        LIGHTCUTS_THROW(invalid_input(path.string() + ": " + problem));
    };
    {
        std::ofstream file(temporary, std::ios::binary);
        if (!file) refuse("cannot be created; is its folder there, and may you write to it?");
        file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        file.close();
        if (!file) refuse("cannot be written to its end; is the disk full?");
    }
    std::filesystem::rename(temporary, path, error);
    if (error) refuse(error.message());
}

}  // namespace lightcuts
