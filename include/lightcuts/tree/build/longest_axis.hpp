#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "build_range.hpp"
#include "normalized_space.hpp"

namespace lightcuts {

namespace detail {

/// The lane of the axis along which a box is longest. `direction_share`: the length that one unit of direction counts
/// for.
template <std::size_t Dimensions>
std::size_t longest_axis(const BuildBounds<Dimensions>& bounds, float direction_share) {
    std::size_t longest = 0;
    float length = -1;
    for (const std::size_t a : BuildItem<Dimensions>::axes) {
        const float l = (bounds.hi[a] - bounds.lo[a]) * (a < 4 ? 1.0f : direction_share);
        if (l > length) {
            length = l;
            longest = a;
        }
    }
    return longest;
}

}  // namespace detail

/// Splitter of `divide`: halves a set at the median of the longest axis of its box, in three dimensions, or six for
/// items with a direction [Walter et al. 2006, Section 5]. The tree has depth ceil(log2 N).
struct LongestAxis {
    /// The length in world units that one unit of a direction's coordinates counts for. Unset: an eighth of the unit of
    /// the space, which is the diagonal of the items' box or, in `divide_into`, what the caller chose. The paper takes
    /// an eighth of the scene's diagonal: give that where lights fill only a part of the scene. 0 ignores directions.
    std::optional<double> direction_length = {};

    /// See `Splitter`. cost: O(items).
    template <std::size_t Dimensions>
    Split<Dimensions> split(const BuildRange<Dimensions>& range, const NormalizedSpace& space) const {
        using Item = BuildItem<Dimensions>;
        const auto bounds = BuildBounds<Dimensions>::of(range.items);
        const std::size_t longest = detail::longest_axis(bounds, space.direction_share(direction_length, 0.125f));
        const std::size_t left = range.items.size() / 2;
        const auto middle = range.items.begin() + static_cast<std::ptrdiff_t>(left);
        // Ties are broken by item, so that the halves are the same sets whatever the standard library does.
        std::nth_element(range.items.begin(), middle, range.items.end(), [longest](const Item& a, const Item& b) {
            return a.lane[longest] != b.lane[longest] ? a.lane[longest] < b.lane[longest] : a.item() < b.item();
        });
        return split_at(range, left);
    }
};

}  // namespace lightcuts
