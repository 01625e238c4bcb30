#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#if __has_include(<sys/mman.h>)
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#define LIGHTCUTS_MAPS_FILES
#endif

#include "../core/invalid_input.hpp"
#include "file_bytes.hpp"

namespace lightcuts {

/// The bytes of a file, which the system reads as they are looked at: mapped where the system is POSIX, else read
/// whole. All readers of this library take bytes, so map files by other means where you have them.
/// The file must not be written to, or made shorter, meanwhile; `write_bytes` replaces it, which is no harm.
class MappedFile {
public:
    /// throws: invalid_input naming the file if it cannot be read, or is a folder, a pipe or a device.
    explicit MappedFile(const std::filesystem::path& path) {
#ifdef LIGHTCUTS_MAPS_FILES
        // A pipe without a writer would be waited for.
        const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
        struct stat status {};
        if (descriptor >= 0 && ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0) {
            const auto size = static_cast<std::size_t>(status.st_size);
            void* const mapped = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
            if (mapped != MAP_FAILED) {
                bytes_ = {static_cast<const std::byte*>(mapped), size};
                is_mapped_ = true;
            }
        }
        if (descriptor >= 0) ::close(descriptor);
        if (is_mapped_) return;
#endif
        copy_ = read_bytes(path);
        bytes_ = copy_;
    }
    MappedFile(MappedFile&& other) noexcept
        : copy_(std::move(other.copy_)), bytes_(std::exchange(other.bytes_, {})),
          is_mapped_(std::exchange(other.is_mapped_, false)) {}
    MappedFile& operator=(MappedFile&& other) noexcept {
        std::swap(copy_, other.copy_);
        std::swap(bytes_, other.bytes_);
        std::swap(is_mapped_, other.is_mapped_);
        return *this;
    }
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;
    ~MappedFile() {
#ifdef LIGHTCUTS_MAPS_FILES
        if (is_mapped_) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
#endif
    }

    std::span<const std::byte> bytes() const { return bytes_; }

private:
    std::vector<std::byte> copy_;
    std::span<const std::byte> bytes_;
    bool is_mapped_ = false;
};

}  // namespace lightcuts

#undef LIGHTCUTS_MAPS_FILES
