#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "../../core/random.hpp"
#include "build_range.hpp"
#include "longest_axis.hpp"
#include "normalized_space.hpp"

namespace lightcuts {

/// Splitter of `divide`: sorts a set into up to 16 bins along each axis of position (and direction) and takes the
/// boundary whose two sides have the smallest sum of intensity x size. The size of items without a direction is the
/// papers' [Walter et al. 2005, Section 4], the squared diagonal of their box; with one it is the diagonal plus a share
/// of that of the directions' box, which leads to smaller cuts than the papers' sum of squares.
struct Binned {
    /// A set of more than twice as many items chooses its boundary from a sample of so many, or of an eighth of them
    /// if that is more. 0: always from all; slower by a sixth, and hardly a better tree.
    std::size_t sample = 4096;

    /// The length in world units that one unit of a direction's coordinates counts for. Unset: a twentieth of the unit
    /// of the space, which is the diagonal of the items' box or, in `divide_into`, what the caller chose. Give a
    /// twentieth of the scene's diagonal where lights fill only a part of the scene. 0 ignores directions.
    std::optional<double> direction_length = {};

    /// See `Splitter`. cost: O(items).
    template <std::size_t Dimensions>
    Split<Dimensions> split(const BuildRange<Dimensions>& range, const NormalizedSpace& space) const;
};

namespace detail {

/// One set of items, sorted into bins along each axis that matters.
template <std::size_t Dimensions>
class Bins {
public:
    using Item = BuildItem<Dimensions>;
    using Bounds = BuildBounds<Dimensions>;
    static constexpr std::size_t max_bins = 16;
    static constexpr std::size_t axis_count = Dimensions;

    /// `count`: of the items that will be split, not all of which need be added.
    Bins(const Bounds& bounds, std::size_t count, float direction_share) : direction_share_(direction_share) {
        bin_count_ = count >= 64 ? max_bins : count >= 16 ? max_bins / 2 : max_bins / 4;
        // An axis that promises little beside another is not worth its bins, least of all for a small set.
        const auto gains = bounds.gains(direction_share);
        const float share = count >= 256 ? 0.05f : count >= 16 ? 0.25f : 0.5f;
        const float least_gain = share * *std::max_element(gains.begin(), gains.end());
        for (std::size_t i = 0; i < axis_count; ++i) {
            const std::size_t a = Item::axes[i];
            const float extent = bounds.hi[a] - bounds.lo[a];
            if (!(extent > 0) || gains[i] < least_gain) continue;
            // Just under bin_count / extent, so that the upper end falls into the last bin.
            const float scale = static_cast<float>(bin_count_) * 0.999999f / extent;
            axes_[live_count_++] = {a, bounds.lo[a], (std::min)(scale, (std::numeric_limits<float>::max)()),
                                    static_cast<float>(bin_count_ - 1)};
        }
        for (std::size_t k = 0; k < live_count_; ++k) {
            std::fill_n(bins_[k].begin(), bin_count_, Bounds::none());
            std::fill_n(weights_[k].begin(), bin_count_, 0.0f);
        }
    }

    /// All items coincide: there is nothing to choose.
    bool is_point() const { return live_count_ == 0; }

    void add(std::span<const Item> items) {
        for (std::size_t k = 0; k < live_count_; ++k) {
            const Axis axis = axes_[k];
            for (const Item& i : items) {
                const std::size_t b = axis.bin(i);
                bins_[k][b].add(i);
                weights_[k][b] += i.weight();
            }
        }
    }

    struct Boundary {
        std::size_t axis = 0;  ///< among the live ones
        std::size_t first_right = 0;
        double cost = std::numeric_limits<double>::infinity();
    };

    /// The boundary with the smallest sum of metrics. pre: !is_point(); some items were added.
    Boundary best_boundary() const {
        Boundary best;
        // The metric of a side without items is NaN, which is never the smallest.
        for (std::size_t k = 0; k < live_count_; ++k) {
            // Step 1: costs of the right sides, from the end.
            std::array<double, max_bins> right_cost;
            Bounds side = Bounds::none();
            double weight = 0;
            for (std::size_t b = bin_count_ - 1; b > 0; --b) {
                side.add(bins_[k][b]);
                weight += static_cast<double>(weights_[k][b]);
                right_cost[b] = weight * static_cast<double>(side.size(direction_share_));
            }
            // Step 2: add those of the left sides.
            side = Bounds::none();
            weight = 0;
            for (std::size_t b = 1; b < bin_count_; ++b) {
                side.add(bins_[k][b - 1]);
                weight += static_cast<double>(weights_[k][b - 1]);
                const double cost = weight * static_cast<double>(side.size(direction_share_)) + right_cost[b];
                if (cost < best.cost) best = {k, b, cost};
            }
        }
        return best;
    }

    /// The predicate of the items on the left of a boundary.
    auto is_left(const Boundary& boundary) const {
        return [axis = axes_[boundary.axis], first_right = boundary.first_right](const Item& i) {
            return axis.bin(i) < first_right;
        };
    }

    Bounds left_bounds(const Boundary& b) const { return bounds(b.axis, 0, b.first_right); }
    Bounds right_bounds(const Boundary& b) const { return bounds(b.axis, b.first_right, bin_count_); }

private:
    struct Axis {
        std::size_t lane;
        float origin, scale, last_bin;

        std::size_t bin(const Item& i) const {
            const float t = (i.lane[lane] - origin) * scale;
            return static_cast<std::size_t>(static_cast<int>((std::max)(0.0f, (std::min)(t, last_bin))));
        }
    };

    Bounds bounds(std::size_t axis, std::size_t first, std::size_t last) const {
        Bounds side = Bounds::none();
        for (std::size_t b = first; b < last; ++b) side.add(bins_[axis][b]);
        return side;
    }

    float direction_share_;
    std::size_t bin_count_ = 0;
    std::size_t live_count_ = 0;
    std::array<Axis, axis_count> axes_;
    std::array<std::array<Bounds, max_bins>, axis_count> bins_;
    std::array<std::array<float, max_bins>, axis_count> weights_;
};

/// Visits `size` of the items, in chunks, one from each of as many equal stretches, so
/// that no order of the items biases it.
template <class Item, class Visit>
void visit_sample(std::span<const Item> items, std::size_t size, Visit&& visit) {
    std::array<Item, 64> chunk;
    const std::size_t stride = items.size() / size;
    for (std::size_t i = 0; i < size;) {
        std::size_t count = 0;
        for (; count < chunk.size() && i < size; ++count, ++i) {
            chunk[count] = items[i * stride + hash_keys(i, items.size()) % stride];
        }
        visit(std::span<const Item>(chunk.data(), count));
    }
}

/// Moves the item to the end without which the other two are the smallest cluster. pre: three items.
template <std::size_t Dimensions>
void single_out(std::span<BuildItem<Dimensions>> items, float direction_share) {
    std::size_t odd = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const BuildItem<Dimensions>&a = items[(i + 1) % 3], &b = items[(i + 2) % 3];
        auto pair = BuildBounds<Dimensions>::none();
        pair.add(a);
        pair.add(b);
        const double size = (static_cast<double>(a.weight()) + static_cast<double>(b.weight())) *
                            static_cast<double>(pair.size(direction_share));
        if (size < least) {
            least = size;
            odd = i;
        }
    }
    std::swap(items[odd], items[2]);
}

}  // namespace detail

template <std::size_t Dimensions>
Split<Dimensions> Binned::split(const BuildRange<Dimensions>& range, const NormalizedSpace& space) const {
    using Item = BuildItem<Dimensions>;
    using Bounds = BuildBounds<Dimensions>;
    const std::span<Item> items = range.items;
    const float direction_share = space.direction_share(direction_length, 0.05f);
    if (items.size() == 3) {
        detail::single_out(items, direction_share);
        return split_at(range, 2);
    }
    const bool sampled = sample > 0 && items.size() > 2 * sample;
    const auto visit = [&](auto&& visitor) {
        if (sampled) {
            detail::visit_sample<Item>(items, (std::max)(sample, items.size() / 8), visitor);
        } else {
            visitor(std::span<const Item>(items));
        }
    };

    Bounds bounds = range.bounds;
    if (sampled || bounds.is_none()) {
        bounds = Bounds::none();
        visit([&](std::span<const Item> some) { bounds.add(Bounds::of(some)); });
    }
    detail::Bins<Dimensions> bins(bounds, items.size(), direction_share);
    if (bins.is_point()) {
        // A sample can be a point where the set is not.
        if (sampled) return LongestAxis{direction_length}.split(range, space);
        const std::size_t half = items.size() / 2;
        return {{items.first(half), bounds}, {items.subspan(half), bounds}};
    }
    visit([&](std::span<const Item> some) { bins.add(some); });
    const auto boundary = bins.best_boundary();
    const std::size_t left = partition_items(items, bins.is_left(boundary));
    // An extent too small for 1 / extent leaves all items in one bin.
    if (left == 0 || left == items.size()) return split_at(range, items.size() / 2);
    if (sampled) return split_at(range, left);
    return {{items.first(left), bins.left_bounds(boundary)}, {items.subspan(left), bins.right_bounds(boundary)}};
}

}  // namespace lightcuts
