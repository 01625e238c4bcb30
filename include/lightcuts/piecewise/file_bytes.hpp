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

/// Makes `bytes` the content of a file: in one step, so that whatever happens to this process there is the old file or
/// the new one. They are written to a file beside it first, which is removed if that fails. A symbolic link stays, and
/// the file that it leads to is written; the permissions of a file that is replaced stay, too.
/// throws: invalid_input naming the file if it cannot be written, or is a folder, a pipe or a device.
inline void write_bytes(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    namespace fs = std::filesystem;
    const auto refuse = [&](const std::string& problem) {
        LIGHTCUTS_THROW(invalid_input(path.string() + ": " + problem));
    };
    std::error_code error;
    fs::path target = path;
    // As many links as systems follow, one after the other: the last may lead to a file that is still to be made.
    for (int links = 0; fs::is_symlink(fs::symlink_status(target, error)); ++links) {
        if (links == 40) refuse("is a symbolic link that leads nowhere");
        const fs::path next = fs::read_symlink(target, error);
        if (error) refuse(error.message());
        target = next.is_absolute() ? next : target.parent_path() / next;
    }
    const fs::file_status old = fs::status(target, error);
    if (fs::exists(old) && !fs::is_regular_file(old)) refuse("is there already, and is no regular file");

    fs::path temporary = target;
    temporary += "." + std::to_string(std::random_device{}()) + ".part";
    const auto remove_and_refuse = [&](const std::string& problem) {
        std::error_code ignored;
        fs::remove(temporary, ignored);
        refuse(problem);
    };
    {
        std::ofstream file(temporary, std::ios::binary);
        if (!file) remove_and_refuse("cannot be created; is its folder there, and may you write to it?");
        // Before anything is in it that others must not read.
        if (fs::exists(old)) {
            fs::permissions(temporary, old.permissions(), error);
            if (error) remove_and_refuse(error.message());
        }
        file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        file.close();
        if (!file) remove_and_refuse("cannot be written to its end; is the disk full?");
    }
    fs::rename(temporary, target, error);
    if (error) remove_and_refuse(error.message());
}

}  // namespace lightcuts
