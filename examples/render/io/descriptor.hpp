#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <utility>

namespace render {

/// Writes all of `bytes` to an open file, at its position. Returns 0, or the error number.
int write_all(int file, std::span<const char> bytes);

/// An open file of the operating system. Closed with this object.
class Descriptor {
public:
    Descriptor() = default;
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { close(); }
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept;

    /// Below 0 if there is none.
    int number() const { return number_; }
    explicit operator bool() const { return number_ >= 0; }

    /// `held`: others are kept out until the file is closed. `busy`: one of them holds it. Not all file systems can.
    enum class Lock { held, busy, impossible };
    Lock lock() const;

    /// True iff `path` itself, which may be a link, is a name of this file.
    bool is_at(const std::filesystem::path& path) const;

    /// Reads up to `bytes.size()` at `offset`. Returns how many there were; -1 on an error.
    std::ptrdiff_t read_at(std::size_t offset, std::span<char> bytes) const;

    /// Returns 0, or the error number of what was written before and could not be kept.
    int close();

private:
    int number_ = -1;
};

}  // namespace render
