#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include <render/io/descriptor.hpp>

namespace daylighting {

/// Finished parts of a long computation, in a file beside what they will become: a run that ends too early leaves them
/// for the next. Each is written with a checksum as soon as it is finished; what a killed program has half written is
/// cut off. threads: `append` may be called by all.
class ChunkFile {
public:
    using Visit = std::function<void(std::uint32_t index, std::vector<std::byte> bytes)>;

    /// Opens the file, or creates it. With `resume`, calls `visit` with each part that is there.
    /// `fingerprint`: of all that the parts depend on. `count`: indices are below it.
    /// throws: invalid_input naming the file if it cannot be written, is in use, is no such file, or, with `resume`, is
    /// of another computation.
    ChunkFile(std::filesystem::path path, std::uint64_t fingerprint, std::uint32_t count, bool resume,
              const Visit& visit);

    const std::filesystem::path& path() const { return path_; }

    /// throws: invalid_input if there is no room.
    void append(std::uint32_t index, std::span<const std::byte> bytes);

    /// Deletes the file.
    void remove();

private:
    void read(std::uint32_t count, const Visit& visit);
    [[noreturn]] void refuse(const std::string& problem) const;

    std::filesystem::path path_;
    render::Descriptor file_;
    std::mutex writing_;
};

}  // namespace daylighting
