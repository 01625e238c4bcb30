#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <span>

#include "build_item.hpp"

namespace lightcuts {

/// The box of a set of build items, in all lanes.
template <std::size_t Dimensions>
struct BuildBounds {
    using Item = BuildItem<Dimensions>;
    static constexpr std::size_t lanes = Item::lanes;

    alignas(16) float lo[lanes];
    alignas(16) float hi[lanes];

    /// The box of no items.
    static BuildBounds none() {
        BuildBounds b;
        std::fill(std::begin(b.lo), std::end(b.lo), std::numeric_limits<float>::infinity());
        std::fill(std::begin(b.hi), std::end(b.hi), -std::numeric_limits<float>::infinity());
        return b;
    }

    static BuildBounds of(std::span<const Item> items) {
        BuildBounds b = none();
        for (const Item& i : items) b.add(i);
        return b;
    }

    bool is_none() const { return !(lo[0] <= hi[0]); }

    void add(const Item& i) { extend(i.lane, i.lane); }
    void add(const BuildBounds& b) { extend(b.lo, b.hi); }

    /// What a set's weight is multiplied by to judge it, see Binned. Positions alone: the squared diagonal. With
    /// directions it is linear, since cosines and distances, and so bounds, vary in proportion to both diagonals;
    /// squares, as in the papers, hardly tell the directions of small sets apart.
    /// `direction_share`: the length that one unit of direction counts for.
    float size([[maybe_unused]] float direction_share) const {
        if constexpr (Dimensions == 6) {
            return std::sqrt(diagonal2()) + direction_share * std::sqrt(direction_diagonal2());
        } else {
            return diagonal2();
        }
    }

    /// By how much, to first order and up to a factor, the size shrinks when the box does along each of Item::axes.
    std::array<float, Dimensions> gains([[maybe_unused]] float direction_share) const {
        std::array<float, Dimensions> gains;
        for (std::size_t i = 0; i < gains.size(); ++i) gains[i] = extent2(Item::axes[i]);
        if constexpr (Dimensions == 6) {
            constexpr float least = (std::numeric_limits<float>::min)();
            const float of_position = 1 / (std::max)(std::sqrt(diagonal2()), least);
            const float of_direction = direction_share / (std::max)(std::sqrt(direction_diagonal2()), least);
            for (std::size_t i = 0; i < gains.size(); ++i) gains[i] *= i < 3 ? of_position : of_direction;
        }
        return gains;
    }

private:
    float extent2(std::size_t lane) const { return (hi[lane] - lo[lane]) * (hi[lane] - lo[lane]); }

    float diagonal2() const { return extent2(0) + extent2(1) + extent2(2); }
    float direction_diagonal2() const requires(Dimensions == 6) { return extent2(4) + extent2(5) + extent2(6); }

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

/// A set of items to split, which the splitter may reorder.
template <std::size_t Dimensions>
struct BuildRange {
    std::span<BuildItem<Dimensions>> items;
    /// What a splitter may leave for the next split of this set: the items' box, or none().
    BuildBounds<Dimensions> bounds = BuildBounds<Dimensions>::none();
};

/// The two sets that a set is split into: its first items and the rest.
template <std::size_t Dimensions>
struct Split {
    BuildRange<Dimensions> left, right;
};

/// The first `left` items of `range` and the rest, of whose boxes nothing is known.
template <std::size_t Dimensions>
Split<Dimensions> split_at(const BuildRange<Dimensions>& range, std::size_t left) {
    return {{range.items.first(left)}, {range.items.subspan(left)}};
}

/// Moves the items for which `goes_left` to the front; returns their number. Free of unpredictable branches.
template <class Item, class Predicate>
std::size_t partition_items(std::span<Item> items, Predicate&& goes_left) {
    std::size_t left = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
        const Item item = items[i];
        items[i] = items[left];
        items[left] = item;
        left += goes_left(item) ? std::size_t{1} : std::size_t{0};
    }
    return left;
}

}  // namespace lightcuts
