#pragma once

#include <filesystem>

#include "io/descriptor.hpp"

namespace render {

/// A file that is not yet what it is to become: `.lightcuts-PROCESS-RANDOM.tmp`, in the folder of its future name. It
/// is locked while this object lives, by which one that is being written differs from one that a killed program left.
class TemporaryFile {
public:
    /// throws: std::system_error if `folder` takes no files.
    explicit TemporaryFile(const std::filesystem::path& folder);
    /// Deletes the file unless it has been renamed.
    ~TemporaryFile();
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    const std::filesystem::path& path() const { return path_; }
    int number() const { return file_.number(); }

    /// Gives the file its name, in the same folder, in place of what has that name. Returns it, still open and locked.
    /// throws: std::system_error.
    Descriptor rename_to(const std::filesystem::path& name);

    struct Slot;

private:
    void create(const std::filesystem::path& folder);
    void forget();

    std::filesystem::path path_;
    Descriptor file_;
    Slot* slot_ = nullptr;
};

/// Deletes the temporary files in `folder` of programs that were killed. What cannot be deleted stays.
void remove_stale_temporaries(const std::filesystem::path& folder);

/// Deletes the temporary files of this process, and lets it create no more: for signal handlers that end the process.
void delete_temporaries() noexcept;

}  // namespace render
