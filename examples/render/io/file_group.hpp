#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "io/output_file.hpp"

namespace render {

/// The files of one picture: those that could be written whole get their names, if the first of them is among them.
class FileGroup {
public:
    /// Writes what `bytes` gives under a temporary name. throws: invalid_input if that fails for the first file; of the
    /// others `commit` tells.
    void add(const std::filesystem::path& path, const std::function<std::vector<char>()>& bytes);

    /// Gives the files their names. throws: invalid_input if a file is missing, with what was written.
    void commit();

private:
    struct File {
        std::filesystem::path path;
        std::unique_ptr<OutputFile> output;
    };

    bool attempt(const std::filesystem::path& path, const std::function<void()>& action);

    std::vector<File> files_;
    std::string problem_;
};

}  // namespace render
