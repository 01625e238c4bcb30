#pragma once

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "../core/invalid_input.hpp"
#include "../core/random.hpp"
#include "../tree/cluster_tree.hpp"

namespace lightcuts {

/// A number that tells trees apart: a hash of the topology and of what leaves are called. cost: O(N).
inline std::uint64_t fingerprint(const ClusterTree& tree) {
    std::uint64_t h = hash_keys(tree.size(), tree.item_bound());
    for (const std::uint32_t word : tree.words()) h = mix_bits(h ^ word);
    return h;
}

namespace detail {

/// Appends numbers to bytes, the lowest byte first whatever the machine.
class ByteWriter {
public:
    explicit ByteWriter(std::vector<std::byte>& bytes) : bytes_(bytes) {}

    template <std::unsigned_integral T>
    void put(T value) {
        for (std::size_t i = 0; i < sizeof(T); ++i) {
            bytes_.push_back(static_cast<std::byte>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xffu));
        }
    }
    void put(float value) { put(std::bit_cast<std::uint32_t>(value)); }

private:
    std::vector<std::byte>& bytes_;
};

/// The number at `at`, the lowest byte first. pre: so many bytes are there.
template <std::unsigned_integral T>
T load(const std::byte* at) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) value |= static_cast<std::uint64_t>(at[i]) << (8 * i);
    return static_cast<T>(value);
}

/// A hash of bytes that notices damage, not malice. cost: some hundred megabytes to gigabytes a second.
inline std::uint64_t checksum(std::span<const std::byte> bytes) {
    std::uint64_t h = mix_bits(bytes.size());
    std::size_t i = 0;
    for (; i + 8 <= bytes.size(); i += 8) {
        h = (h ^ load<std::uint64_t>(bytes.data() + i)) * 0x9fb21c651e98df25u;
        h ^= h >> 32;
    }
    for (; i < bytes.size(); ++i) h = (h ^ static_cast<std::uint64_t>(bytes[i])) * 0x9fb21c651e98df25u;
    return mix_bits(h);
}

/// Takes numbers off the front of bytes of a file.
class ByteReader {
public:
    ByteReader(std::span<const std::byte> bytes, const char* what) : bytes_(bytes), what_(what) {}

    std::size_t left() const { return bytes_.size() - at_; }
    template <std::unsigned_integral T>
    T number() {
        return load<T>(take(sizeof(T)).data());
    }
    float real() { return std::bit_cast<float>(number<std::uint32_t>()); }
    /// throws: invalid_input if there are not so many.
    std::span<const std::byte> take(std::size_t count) {
        if (count > left())
            refuse("is cut short: " + std::to_string(count) + " more bytes are needed at byte " + std::to_string(at_) +
                   ", but only " + std::to_string(left()) + " are there");
        at_ += count;
        return bytes_.subspan(at_ - count, count);
    }
    [[noreturn]] void refuse(const std::string& problem) const {
        LIGHTCUTS_THROW(invalid_input(std::string(what_) + " " + problem));
    }

private:
    std::span<const std::byte> bytes_;
    const char* what_;
    std::size_t at_ = 0;
};

/// What both kinds of file begin with: eight letters, a version, and a checksum of what follows the header.
struct FileKind {
    const char* what;  ///< as errors call it
    const char (&magic)[9];
    std::uint32_t version;
};

constexpr std::size_t file_header_size = 8 + 4 + 4 + 8;
constexpr std::uint32_t byte_order_mark = 0x0a0b0c0du;

/// Makes `bytes`, which has room for the header in front, a file.
inline void seal(std::vector<std::byte>& bytes, std::size_t checked, const FileKind& kind) {
    std::vector<std::byte> header;
    ByteWriter out(header);
    for (int i = 0; i < 8; ++i) out.put(static_cast<std::uint8_t>(kind.magic[i]));
    out.put(kind.version);
    out.put(byte_order_mark);
    out.put(checksum(std::span(bytes).subspan(file_header_size, checked)));
    std::copy(header.begin(), header.end(), bytes.begin());
}

/// Checks the header of a file; `expect_checksum` then is to be compared.
class SealedReader : public ByteReader {
public:
    SealedReader(std::span<const std::byte> bytes, const FileKind& kind) : ByteReader(bytes, kind.what), all_(bytes) {
        const std::size_t compared = std::min<std::size_t>(bytes.size(), 8);
        if (compared == 0 || std::memcmp(bytes.data(), kind.magic, compared) != 0) {
            refuse(std::string("does not begin with ") + kind.magic + ": it is another kind of file");
        }
        take(8);
        const auto version = number<std::uint32_t>();
        const auto order = number<std::uint32_t>();
        if (order != byte_order_mark) {
            refuse(order == 0x0d0c0b0au ? "has the bytes of its numbers in the other order; write it anew"
                                        : "has a damaged header");
        }
        if (version != kind.version) {
            refuse("is of version " + std::to_string(version) + ", not " + std::to_string(kind.version) +
                   "; write it anew");
        }
        checksum_ = number<std::uint64_t>();
    }
    /// throws: invalid_input unless the first `size` bytes behind the header are those that were written.
    void check(std::size_t size) const {
        if (size > all_.size() - file_header_size) {
            refuse("is cut short: it has " + std::to_string(all_.size()) + " bytes of " +
                   std::to_string(size + file_header_size));
        }
        if (checksum(all_.subspan(file_header_size, size)) != checksum_) refuse("is damaged: its checksum is wrong");
    }

private:
    std::span<const std::byte> all_;
    std::uint64_t checksum_ = 0;
};

}  // namespace detail

}  // namespace lightcuts
