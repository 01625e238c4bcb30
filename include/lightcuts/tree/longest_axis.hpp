#pragma once

#include <algorithm>
#include <cstddef>

#include "record.hpp"

namespace lightcuts {

/// Splitter of `divide`: halves a set at the median of the longest axis of its box, in three dimensions, or six for
/// items with an axis, whose coordinates count an eighth of the scene's diagonal each [Walter et al. 2006, Section 5].
/// The tree has depth ceil(log2 N).
struct LongestAxis {
    template <class Record>
    detail::Halves<Record> split(const detail::Part<Record>& part) const {
        const auto bounds = detail::Bounds<Record>::of(part.records);
        std::size_t longest = 0;
        float length = -1;
        for (const std::size_t a : Record::axes) {
            const float l = (bounds.hi[a] - bounds.lo[a]) * (a < 4 ? 1.0f : 0.125f);
            if (l > length) {
                length = l;
                longest = a;
            }
        }
        const std::size_t left = part.records.size() / 2;
        const auto middle = part.records.begin() + static_cast<std::ptrdiff_t>(left);
        // Ties are broken by item, so that the halves are the same sets whatever the standard library does.
        std::nth_element(part.records.begin(), middle, part.records.end(), [longest](const Record& a, const Record& b) {
            return a.lane[longest] != b.lane[longest] ? a.lane[longest] < b.lane[longest] : a.item() < b.item();
        });
        const auto none = detail::Bounds<Record>::none();
        return {{part.records.first(left), none}, {part.records.subspan(left), none}};
    }
};

}  // namespace lightcuts
