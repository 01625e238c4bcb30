#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "io/temporary_file.hpp"

namespace render {

/// throws: invalid_input unless a file can be created at `path`: its folder exists and takes files, and nothing but
/// a regular file that may be replaced has the name. Leaves nothing behind, not even what killed programs left there.
void require_writable(const std::filesystem::path& path);

/// throws: invalid_input if what is written to `output` would replace the file `input`, whatever links lead there.
void require_apart(const std::filesystem::path& output, const std::filesystem::path& input);

/// A file under a temporary name beside its target. `commit` gives it the target's name in one step; without it the
/// file is deleted, so that a target is either the old file or a whole new one. Of a symbolic link the target is what
/// it leads to, whether that exists or not. What fails names the target as it was given.
class OutputFile {
public:
    /// throws: invalid_input as `require_writable`.
    explicit OutputFile(std::filesystem::path target);

    /// Where it is until then; others may write there too.
    const std::filesystem::path& path() const { return temporary_->path(); }

    /// Appends. throws: invalid_input if it does not fit on the disk, or the like.
    void write(std::span<const char> bytes);

    /// throws: invalid_input if the system refuses, also what it took before.
    void commit();

private:
    std::filesystem::path name_;
    std::filesystem::path target_;
    std::unique_ptr<TemporaryFile> temporary_;
};

/// Makes `bytes` the content of the file `target`, in one step. throws: invalid_input as OutputFile.
void write_file(const std::filesystem::path& target, std::span<const char> bytes);

/// `file` with another extension: `suffix`, which begins with a dot. A name that would be too long for the system is
/// shortened and stays the name of this file alone.
std::filesystem::path beside(const std::filesystem::path& file, const std::string& suffix);

}  // namespace render
