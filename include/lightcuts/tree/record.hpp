#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <memory>
#include <span>

#include "frame.hpp"

namespace lightcuts::detail {

/// What splitters see of an item, in the builder's frame and laid out for vector instructions: x, y, z, weight and,
/// with Oriented, the three coordinates of the axis.
template <bool Oriented>
struct Record {
    static constexpr std::size_t lanes = 4;
    static constexpr std::array<std::size_t, 3> axes{0, 1, 2};  ///< the lanes along which a set can be split

    float lane[lanes];
    std::uint32_t index;

    std::uint32_t item() const { return index; }
    void set_item(std::uint32_t i) { index = i; }
    float weight() const { return lane[3]; }
};

template <>
struct Record<true> {
    static constexpr std::size_t lanes = 8;
    static constexpr std::array<std::size_t, 6> axes{0, 1, 2, 4, 5, 6};

    float lane[lanes];  ///< the last holds the item's bits: item < max_items, so they are never NaN

    std::uint32_t item() const { return std::bit_cast<std::uint32_t>(lane[7]); }
    void set_item(std::uint32_t i) { lane[7] = std::bit_cast<float>(i); }
    float weight() const { return lane[3]; }
};

template <class Item>
using record_of = Record<HasAxis<Item>>;

/// pre: checked items. cost: two passes.
template <class Item>
std::unique_ptr<record_of<Item>[]> make_records(std::span<const Item> items) {
    const Frame frame = Frame::of(items);
    // Left unset; not std::make_unique_for_overwrite, which libc++ 14 lacks.
    std::unique_ptr<record_of<Item>[]> records(new record_of<Item>[items.size()]);
    for (std::size_t i = 0; i < items.size(); ++i) {
        const Item& item = items[i];
        auto& r = records[i];
        const auto position = frame.position(item.position);
        std::copy(position.begin(), position.end(), r.lane);
        r.lane[3] = (std::max)(static_cast<float>(frame.weight(item.weight)), (std::numeric_limits<float>::min)());
        if constexpr (HasAxis<Item>) {
            r.lane[4] = item.axis.x;
            r.lane[5] = item.axis.y;
            r.lane[6] = item.axis.z;
        }
        r.set_item(static_cast<std::uint32_t>(i));
    }
    return records;
}

/// The box of a set of records, in all lanes.
template <class Record>
struct Bounds {
    static constexpr std::size_t lanes = Record::lanes;
    /// What a difference between unit axes counts for, in diagonals of all items' box.
    static constexpr float axis_share = 0.05f;

    alignas(16) float lo[lanes];
    alignas(16) float hi[lanes];

    static Bounds none() {
        Bounds b;
        std::fill(std::begin(b.lo), std::end(b.lo), std::numeric_limits<float>::infinity());
        std::fill(std::begin(b.hi), std::end(b.hi), -std::numeric_limits<float>::infinity());
        return b;
    }

    static Bounds of(std::span<const Record> records) {
        Bounds b = none();
        for (const Record& r : records) b.add(r);
        return b;
    }

    bool is_none() const { return !(lo[0] <= hi[0]); }

    void add(const Record& r) { extend(r.lane, r.lane); }
    void add(const Bounds& b) { extend(b.lo, b.hi); }

    /// What a set's intensity is multiplied by to judge it, see Binned. Positions alone: the squared diagonal. With
    /// axes it is linear, since cosines and distances, and so bounds, vary in proportion to both diagonals; squares, as
    /// in the papers, hardly tell the axes of small sets apart.
    float size() const {
        if constexpr (lanes == 8) {
            return std::sqrt(diagonal2()) + axis_share * std::sqrt(axis_diagonal2());
        } else {
            return diagonal2();
        }
    }

    /// By how much, to first order and up to a factor, the size shrinks when the box does along each of Record::axes.
    std::array<float, Record::axes.size()> gains() const {
        std::array<float, Record::axes.size()> gains;
        for (std::size_t i = 0; i < gains.size(); ++i) gains[i] = extent2(Record::axes[i]);
        if constexpr (lanes == 8) {
            const float of_position = 1 / (std::max)(std::sqrt(diagonal2()), (std::numeric_limits<float>::min)());
            const float of_axis = axis_share /
                                  (std::max)(std::sqrt(axis_diagonal2()), (std::numeric_limits<float>::min)());
            for (std::size_t i = 0; i < gains.size(); ++i) gains[i] *= i < 3 ? of_position : of_axis;
        }
        return gains;
    }

private:
    float extent2(std::size_t lane) const { return (hi[lane] - lo[lane]) * (hi[lane] - lo[lane]); }

    float diagonal2() const { return extent2(0) + extent2(1) + extent2(2); }
    float axis_diagonal2() const requires(lanes == 8) { return extent2(4) + extent2(5) + extent2(6); }

    /// Builders spend most of their time here. Not inlined, and through arrays that alias nothing: so compilers use
    /// vector instructions (GCC 12 does not inside its callers' loops).
    [[gnu::noinline]] void extend(const float (&low)[lanes], const float (&high)[lanes]) {
        float l[lanes], h[lanes];
        for (std::size_t i = 0; i < lanes; ++i) l[i] = lo[i] < low[i] ? lo[i] : low[i];
        for (std::size_t i = 0; i < lanes; ++i) h[i] = hi[i] > high[i] ? hi[i] : high[i];
        std::copy(std::begin(l), std::end(l), lo);
        std::copy(std::begin(h), std::end(h), hi);
    }
};

/// Moves the records for which `goes_left` to the front; returns their number. Free of unpredictable branches.
template <class Record, class Predicate>
std::size_t partition_records(std::span<Record> records, Predicate&& goes_left) {
    std::size_t left = 0;
    for (std::size_t i = 0; i < records.size(); ++i) {
        const Record r = records[i];
        records[i] = records[left];
        records[left] = r;
        left += goes_left(r) ? 1u : 0u;
    }
    return left;
}

/// A set of records to split.
template <class Record>
struct Part {
    std::span<Record> records;
    Bounds<Record> bounds;         ///< none() where the splitter has not needed them yet
    std::uint32_t first_node = 0;  ///< of its subtree, in post-order; set by the builder
    unsigned depth = 0;            ///< likewise
};

template <class Record>
struct Halves {
    Part<Record> left, right;
};

}  // namespace lightcuts::detail
