#pragma once

#include <filesystem>

namespace render {

/// throws: invalid_input unless a file can be created at `path`: its folder exists and takes files, and nothing but
/// a regular file that may be replaced has the name. Leaves nothing behind.
void require_writable(const std::filesystem::path& path);

/// A file under a temporary name beside its target. `commit` gives it the target's name in one step; without it the
/// file is deleted, so that a target is either the old file or a whole new one.
class OutputFile {
public:
    /// throws: invalid_input as `require_writable`.
    explicit OutputFile(std::filesystem::path target);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Where to write.
    const std::filesystem::path& path() const { return temporary_; }

    /// throws: invalid_input if the system refuses.
    void commit();

private:
    std::filesystem::path target_;
    std::filesystem::path temporary_;
};

}  // namespace render
