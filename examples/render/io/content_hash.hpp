#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include <glm/vec3.hpp>

namespace render {

/// True iff no byte of a `T` is padding: a number, or an object of nothing but 4-byte numbers.
template <class T>
inline constexpr bool is_packed = std::is_arithmetic_v<T> || std::is_enum_v<T> || alignof(T) == alignof(float);
template <glm::length_t N, class Number, glm::qualifier Q>
inline constexpr bool is_packed<glm::vec<N, Number, Q>> = std::is_arithmetic_v<Number>;

/// A hash of bytes in their order, by which equal contents are told from others: no two differ in one byte alone.
/// Against chance and faults, not against those who want another content of the same hash.
class ContentHash {
public:
    std::uint64_t value() const { return state_; }

    ContentHash& add_bytes(const void* data, std::size_t size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (; size >= sizeof(std::uint64_t); size -= sizeof(std::uint64_t), bytes += sizeof(std::uint64_t)) {
            std::uint64_t word = 0;
            std::memcpy(&word, bytes, sizeof word);
            add_word(word);
        }
        std::uint64_t rest = 0;
        if (size > 0) std::memcpy(&rest, bytes, size);  // an empty list has no address
        add_word(rest);
        add_word(size);
        return *this;
    }

    ContentHash& add(const std::string& text) { return add_size(text.size()).add_bytes(text.data(), text.size()); }

    template <class T>
    ContentHash& add(const T& value) {
        static_assert(std::is_trivially_copyable_v<T> && is_packed<T>);
        return add_bytes(&value, sizeof value);
    }

    template <class T>
    ContentHash& add(const std::vector<T>& values) {
        static_assert(std::is_trivially_copyable_v<T> && is_packed<T>);
        return add_size(values.size()).add_bytes(values.data(), values.size() * sizeof(T));
    }

private:
    ContentHash& add_size(std::size_t size) {
        add_word(size);
        return *this;
    }

    /// Each step can be undone, so that different words from one state lead to different states.
    void add_word(std::uint64_t word) {
        state_ = (state_ ^ word) * 0x9e3779b97f4a7c15u;
        state_ ^= state_ >> 32;
    }

    std::uint64_t state_ = 0x243f6a8885a308d3u;
};

}  // namespace render
