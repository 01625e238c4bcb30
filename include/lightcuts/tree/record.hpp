#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <type_traits>

#include "../core/invalid_input.hpp"
#include "../core/vector.hpp"
#include "cluster_tree.hpp"
#include "item.hpp"

namespace lightcuts::detail {

template <class Item>
concept HasAxis = requires(const Item& i) { i.axis; };

/// throws: invalid_input, naming the first item that a builder cannot use. cost: one pass.
template <class Item>
void check_items(std::span<const Item> items) {
    if (items.size() > ClusterTree::max_items) {
        throw invalid_input("a cluster tree holds at most " + std::to_string(ClusterTree::max_items) +
                            " items, not " + std::to_string(items.size()));
    }
    for (std::size_t i = 0; i < items.size(); ++i) {
        const Item& item = items[i];
        const auto refuse = [i](const char* what) { throw invalid_input("item " + std::to_string(i) + ": " + what); };
        if (!is_finite(item.position)) refuse("the position is not finite");
        if (!(item.weight > 0.0f && item.weight <= std::numeric_limits<float>::max())) {
            refuse("the weight is not positive and finite; drop dark lights first");
        }
        if constexpr (HasAxis<Item>) {
            const glm::vec3& a = item.axis;
            if (!(std::abs(a.x * a.x + a.y * a.y + a.z * a.z - 1.0f) <= 1e-3f)) refuse("the axis is not a unit vector");
        }
    }
}

/// The frame in which builders measure: lengths in units of the diagonal of all items' box, weights in units of the
/// largest. The metric's constant c is 1 in this frame.
struct Frame {
    std::array<double, 3> origin{};
    double per_length = 1;  ///< 1 / diagonal; 1 if all items coincide
    double per_weight = 1;

    template <class Item>
    static Frame of(std::span<const Item> items) {
        if (items.empty()) return {};
        constexpr float inf = std::numeric_limits<float>::infinity();
        std::array<float, 3> lo{inf, inf, inf}, hi{-inf, -inf, -inf};
        float weight = 0;
        for (const Item& item : items) {
            const std::array<float, 3> p{item.position.x, item.position.y, item.position.z};
            for (std::size_t a = 0; a < 3; ++a) {
                lo[a] = std::min(lo[a], p[a]);
                hi[a] = std::max(hi[a], p[a]);
            }
            weight = std::max(weight, item.weight);
        }
        Frame frame;
        double diagonal2 = 0;
        for (std::size_t a = 0; a < 3; ++a) {
            const double extent = static_cast<double>(hi[a]) - static_cast<double>(lo[a]);
            frame.origin[a] = static_cast<double>(lo[a]);
            diagonal2 += extent * extent;
        }
        if (diagonal2 > 0) frame.per_length = 1 / std::sqrt(diagonal2);
        frame.per_weight = 1 / static_cast<double>(weight);
        return frame;
    }

    /// Coordinates in [0, 1].
    std::array<float, 3> position(const glm::vec3& p) const {
        const auto coordinate = [this](float x, std::size_t axis) {
            return static_cast<float>((static_cast<double>(x) - origin[axis]) * per_length);
        };
        return {coordinate(p.x, 0), coordinate(p.y, 1), coordinate(p.z, 2)};
    }
    double weight(float w) const { return static_cast<double>(w) * per_weight; }
};

/// What splitters see of an item, in the builder's frame and laid out for vector instructions: x, y, z, weight and,
/// with Oriented, the three coordinates of the axis.
template <bool Oriented>
struct Record {
    static constexpr std::size_t lanes = 4;
    static constexpr std::array<std::size_t, 3> axes{0, 1, 2};  ///< lanes in which a set can be split

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
    auto records = std::make_unique_for_overwrite<record_of<Item>[]>(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
        const Item& item = items[i];
        auto& r = records[i];
        const auto position = frame.position(item.position);
        std::copy(position.begin(), position.end(), r.lane);
        r.lane[3] = std::max(static_cast<float>(frame.weight(item.weight)), std::numeric_limits<float>::min());
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
    alignas(16) float lo[Record::lanes];
    alignas(16) float hi[Record::lanes];

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

    /// By how much, to first order, the size shrinks along each of Record::axes when the box does.
    std::array<float, Record::axes.size()> gains() const {
        std::array<float, Record::axes.size()> gains;
        float spread = 0;
        for (std::size_t i = 0; i < gains.size(); ++i) {
            const float e = hi[Record::axes[i]] - lo[Record::axes[i]];
            gains[i] = e * e;
            if (i >= 3) spread += 0.125f * e * e;
        }
        for (std::size_t i = 3; i < gains.size(); ++i) gains[i] *= 0.25f * spread;
        return gains;
    }

    /// The papers' metric without its intensity, alpha^2 + c^2 (1 - cos beta)^2, the cone being measured by the box
    /// of the axes: two axes at opposite corners of a box of diagonal d have 1 - cos beta = d^2/8 + O(d^4).
    float size() const {
        const float x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];
        float size = x * x + y * y + z * z;
        if constexpr (Record::lanes == 8) {
            const float u = hi[4] - lo[4], v = hi[5] - lo[5], w = hi[6] - lo[6];
            const float spread = 0.125f * (u * u + v * v + w * w);
            size += spread * spread;
        }
        return size;
    }

private:
    /// Through local arrays, which alias nothing, and not unrolled before vectorisation: compilers then use vector
    /// instructions (GCC 12 -O3 otherwise does not).
    [[gnu::noinline]] void extend(const float (&low)[Record::lanes], const float (&high)[Record::lanes]) {
        float l[Record::lanes], h[Record::lanes];
        for (std::size_t i = 0; i < Record::lanes; ++i) l[i] = lo[i] < low[i] ? lo[i] : low[i];
        for (std::size_t i = 0; i < Record::lanes; ++i) h[i] = hi[i] > high[i] ? hi[i] : high[i];
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
        left += goes_left(r) ? 1 : 0;
    }
    return left;
}

/// A set of records with its bounds; none() where nobody has needed them yet.
template <class Record>
struct Part {
    std::span<Record> records;
    Bounds<Record> bounds;
    std::uint32_t first_node = 0;  ///< of its subtree, in post-order; set by the builder
    unsigned depth = 0;            ///< likewise
};

}  // namespace lightcuts::detail
