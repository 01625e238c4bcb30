#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include "record.hpp"

namespace lightcuts {

/// Splitter of `divide`: halves a set at the median of the longest axis of its box, in three dimensions, or six for
/// items with a direction (whose axes are scaled by an eighth of the scene's diagonal, as in Multidimensional
/// Lightcuts). Gives a balanced tree of depth ceil(log2 N).
struct LongestAxis {
    template <class Record>
    std::pair<detail::Part<Record>, detail::Part<Record>> split(const detail::Part<Record>& part) const {
        const auto bounds = detail::Bounds<Record>::of(part.records);
        std::size_t longest = 0;
        float extent = -1;
        for (const std::size_t a : Record::axes) {
            const float e = (bounds.hi[a] - bounds.lo[a]) * (a < 4 ? 1.0f : 0.125f);
            if (e > extent) {
                extent = e;
                longest = a;
            }
        }
        const auto middle = part.records.begin() + static_cast<std::ptrdiff_t>(part.records.size() / 2);
        // Ties are broken by item, so that the halves do not depend on the library's nth_element.
        std::nth_element(part.records.begin(), middle, part.records.end(), [longest](const Record& a, const Record& b) {
            return a.lane[longest] != b.lane[longest] ? a.lane[longest] < b.lane[longest] : a.item() < b.item();
        });
        const std::size_t left = part.records.size() / 2;
        const auto none = detail::Bounds<Record>::none();
        return {{part.records.first(left), none}, {part.records.subspan(left), none}};
    }
};

}  // namespace lightcuts
