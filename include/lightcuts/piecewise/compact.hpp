#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "../core/invalid_input.hpp"
#include "../core/rounding.hpp"
#include "../tree/cluster_tree.hpp"
#include "bytes.hpp"
#include "piecewise_constant.hpp"

namespace lightcuts {

/// How the values of a stored cut are rounded.
enum class ValueBits : std::uint8_t {
    eight = 8,     ///< 3 bytes a piece
    sixteen = 16,  ///< 4 bytes a piece
    full = 32,     ///< 6 bytes a piece, exact
};

/// How a cut is stored.
struct CutEncoding {
    /// 8 and 16: 255 or 65,535 even steps from the least to the largest value of the cut, which both are exact.
    ValueBits bits = ValueBits::eight;
    /// 2 bytes a piece more, for bounds of errors, which then count in the rounding of the values.
    bool deviations = false;
};

/// The largest difference of a stored value from the one that was to be stored, in a cut of values from `least` to
/// `largest`.
inline float quantization_error(float least, float largest, ValueBits bits) {
    if (bits == ValueBits::full || !(least < largest)) return 0.0f;
    const double steps = bits == ValueBits::eight ? 255.0 : 65535.0;
    const double range = static_cast<double>(largest) - static_cast<double>(least);
    const double magnitude = (std::max)(std::abs(static_cast<double>(least)), std::abs(static_cast<double>(largest)));
    // Half a step, and what rounding to float may add.
    return round_up(0.5 * range / steps * (1.0 + 0x1p-40) + magnitude * 0x1p-24 + 0x1p-149);
}

namespace detail {

constexpr std::size_t cut_header_size = 24;

/// The upper half of the bits of the next float that has no lower half. pre: x >= 0.
constexpr std::uint16_t round_up_to_16_bits(float x) {
    const auto bits = std::bit_cast<std::uint32_t>(x);
    return static_cast<std::uint16_t>((bits + 0xffffu) >> 16);
}
constexpr float from_16_bits(std::uint16_t bits) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(bits) << 16);
}

/// Even steps between two floats.
class Quantizer {
public:
    Quantizer(float least, float largest, ValueBits bits)
        : least_(least), largest_(largest), last_(bits == ValueBits::eight ? 255u : 65535u),
          step_((static_cast<double>(largest) - static_cast<double>(least)) / static_cast<double>(last_)) {}

    std::uint16_t operator()(float value) const {
        if (!(step_ > 0.0)) return 0;
        const double at = std::round((static_cast<double>(value) - static_cast<double>(least_)) / step_);
        return static_cast<std::uint16_t>((std::min)(at, static_cast<double>(last_)));
    }
    float value(std::uint16_t q) const {
        return q == last_ ? largest_ : static_cast<float>(static_cast<double>(least_) + q * step_);
    }

private:
    float least_, largest_;
    std::uint16_t last_;
    double step_;
};

}  // namespace detail

/// Appends a cut to `bytes`: 24 bytes and, a piece, 2 of how far its node is from the one before, which take 4 more
/// where that is above 65,535, then those of the value, and of the deviation. Scalars only: of several channels store
/// each. Stored values are off by at most `quantization_error` of the least and the largest.
/// throws: invalid_input if nodes do not ascend, a value is not finite, or there are no deviations to be stored; then
/// nothing was appended. cost: O(size).
inline void encode(const PiecewiseConstant<float>& f, const CutEncoding& encoding, std::vector<std::byte>& bytes) {
    if (encoding.deviations && !f.empty() && !f.has_deviations()) {
        LIGHTCUTS_THROW(invalid_input("encode: the cut has no deviations to be stored; approximate it with them"));
    }
    float least = 0.0f, largest = 0.0f, offset = 0.0f;
    std::uint32_t wide = 0;
    std::int64_t last = -1;
    for (std::size_t i = 0; i < f.size(); ++i) {
        const float v = f.values()[i];
        const std::uint32_t node = f.pieces()[i].node();
        if (node <= last) detail::refuse_piece(i, node, "nodes of a cut have to ascend; sort them");
        detail::check_finite(i, f.pieces()[i], v);
        least = i == 0 ? v : (std::min)(least, v);
        largest = i == 0 ? v : (std::max)(largest, v);
        if (encoding.deviations) offset = (std::max)(offset, f.deviation(i).offset);
        wide += node - last > 0xffff ? 1u : 0u;
        last = node;
    }
    const std::size_t begin = bytes.size();
    detail::ByteWriter out(bytes);
    out.put(std::uint32_t{0});  // the checksum
    out.put(static_cast<std::uint32_t>(f.size()));
    out.put(wide);
    out.put(least);
    out.put(largest);
    out.put(offset);
    last = -1;
    for (const Piece& piece : f.pieces()) {
        const auto step = static_cast<std::uint32_t>(piece.node() - last);
        if (step > 0xffff) {
            out.put(std::uint16_t{0});
            out.put(step);
        } else {
            out.put(static_cast<std::uint16_t>(step));
        }
        last = piece.node();
    }
    const detail::Quantizer quantize(least, largest, encoding.bits);
    for (const float v : f.values()) {
        switch (encoding.bits) {
            case ValueBits::eight: out.put(static_cast<std::uint8_t>(quantize(v))); break;
            case ValueBits::sixteen: out.put(quantize(v)); break;
            case ValueBits::full: out.put(v); break;
        }
    }
    for (std::size_t i = 0; encoding.deviations && i < f.size(); ++i) {
        out.put(detail::round_up_to_16_bits(f.deviation(i).norm));
    }
    const std::span<const std::byte> body = std::span<const std::byte>(bytes).subspan(begin + 4);
    const auto sum = static_cast<std::uint32_t>(detail::checksum(body));
    for (std::size_t i = 0; i < 4; ++i) bytes[begin + i] = static_cast<std::byte>(sum >> (8 * i) & 0xffu);
}

/// Makes `out` the function that `encode` stored in `bytes`, all of them, valid on `tree`. Its deviations hold for the
/// values as they are stored. `index`: what errors call the cut.
/// throws: invalid_input, one line, if the bytes are cut short, damaged or of a cut of another tree.
/// cost: O(size), in trees that are not binary O(N); allocates nothing if `out` has room.
inline void decode(std::span<const std::byte> bytes, const CutEncoding& encoding, const ClusterTree& tree,
                   PiecewiseConstant<float>& out, std::size_t index = detail::no_cut_index) {
    const auto refuse = [&](const char* problem) {
        LIGHTCUTS_THROW(invalid_input(
            "cut" + (index == detail::no_cut_index ? std::string() : " " + std::to_string(index)) + ": " + problem));
    };
    detail::Filling filling(out);
    if (bytes.size() < detail::cut_header_size) refuse("is cut short");
    const auto word = [&](std::size_t i) { return detail::load<std::uint32_t>(bytes.data() + 4 * i); };
    if (word(0) != static_cast<std::uint32_t>(detail::checksum(bytes.subspan(4)))) {
        refuse("is damaged: its checksum is wrong");
    }
    const std::uint64_t count = word(1), wide = word(2);
    const auto least = std::bit_cast<float>(word(3)), largest = std::bit_cast<float>(word(4)),
               offset = std::bit_cast<float>(word(5));
    const std::uint64_t value_size = static_cast<std::uint64_t>(encoding.bits) / 8;
    const std::uint64_t size = count * (2 + value_size + (encoding.deviations ? 2 : 0)) + 4 * wide;
    if (wide > count || size != bytes.size() - detail::cut_header_size) refuse("has not the size that it says");
    if (!(std::isfinite(least) && least <= largest && std::isfinite(largest)) || !(offset >= 0.0f)) {
        refuse("has a range of values that is none");
    }

    const std::byte* at = bytes.data() + detail::cut_header_size;
    const std::byte* value_at = at + 2 * count + 4 * wide;
    const std::byte* const values_begin = value_at;
    const std::byte* deviation_at = value_at + value_size * count;
    const detail::Quantizer quantized(least, largest, encoding.bits);
    detail::CutWalk walk(tree, index);
    std::uint64_t next = 0;  // one above the node before
    for (std::size_t i = 0; i < count; ++i) {
        if (values_begin - at < 2) refuse("has not the nodes that it says");
        std::uint64_t step = detail::load<std::uint16_t>(at);
        at += 2;
        if (step == 0) {
            if (values_begin - at < 4) refuse("has not the nodes that it says");
            step = detail::load<std::uint32_t>(at);
            at += 4;
        }
        next += step;
        if (step == 0 || next > tree.size()) {
            detail::refuse_piece(i, static_cast<std::uint32_t>(next),
                                 "is no node that may follow; a cut of another tree", index);
        }
        const Piece piece = walk.next(i, static_cast<std::uint32_t>(next - 1));
        float value = 0.0f;
        switch (encoding.bits) {
            case ValueBits::eight: value = quantized.value(detail::load<std::uint8_t>(value_at)); break;
            case ValueBits::sixteen: value = quantized.value(detail::load<std::uint16_t>(value_at)); break;
            case ValueBits::full: value = std::bit_cast<float>(detail::load<std::uint32_t>(value_at)); break;
        }
        value_at += value_size;
        detail::check_finite(i, piece, value);
        out.append(piece, value);
    }
    if (at != values_begin) refuse("has not the nodes that it says");
    walk.finish(count);
    const auto error = static_cast<double>(quantization_error(least, largest, encoding.bits));
    for (std::size_t i = 0; encoding.deviations && i < count; ++i, deviation_at += 2) {
        const auto norm = static_cast<double>(detail::from_16_bits(detail::load<std::uint16_t>(deviation_at)));
        if (!(norm >= 0.0)) refuse("has a deviation that is no number");
        const double more = error * std::sqrt(static_cast<double>(out.leaves(i)));
        out.append_deviation(
            {round_up((norm + more) * (1.0 + 0x1p-50)), round_up(static_cast<double>(offset) + error)});
    }
    filling.finish();
}

}  // namespace lightcuts
