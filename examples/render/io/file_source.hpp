#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace render {

/// Where the files of a scene come from: the disk, or memory.
class FileSource {
public:
    virtual ~FileSource() = default;

    /// The whole file. throws: invalid_input naming it when it is not there or cannot be read.
    virtual std::string read(const std::filesystem::path& path) const = 0;

    /// The path of the file that `name`, as an OBJ or MTL file writes it, means in `folder`: quotes around it are
    /// dropped, backslashes separate folders, `\ ` is a blank. Where there is no such file, one whose name differs by
    /// upper and lower case alone, if there is just one. Empty: there is none.
    std::optional<std::filesystem::path> find(const std::filesystem::path& folder, std::string_view name) const;

private:
    virtual bool has(const std::filesystem::path& path) const = 0;
    /// The file beside `path` whose name is the same but for upper and lower case; empty if none is, or several are.
    virtual std::optional<std::filesystem::path> similar(const std::filesystem::path& path) const = 0;
};

/// Files on the disk. Pipes can be read too; devices and what is larger than memory cannot. For one thread.
class DiskFiles final : public FileSource {
public:
    std::string read(const std::filesystem::path& path) const override;

    /// Those that were read so far, or tried.
    const std::vector<std::filesystem::path>& taken() const { return taken_; }

private:
    bool has(const std::filesystem::path& path) const override;
    std::optional<std::filesystem::path> similar(const std::filesystem::path& path) const override;

    mutable std::vector<std::filesystem::path> taken_;
};

/// Files that the program holds itself.
class MemoryFiles final : public FileSource {
public:
    explicit MemoryFiles(std::map<std::string, std::string> files) : files_(std::move(files)) {}

    std::string read(const std::filesystem::path& path) const override;

private:
    bool has(const std::filesystem::path& path) const override;
    std::optional<std::filesystem::path> similar(const std::filesystem::path& path) const override;

    std::map<std::string, std::string> files_;  ///< by path
};

}  // namespace render
