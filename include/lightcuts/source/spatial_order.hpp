#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace lightcuts::detail {

/// An order of points in which consecutive ones lie close together: boxes are halved across their longest side, and
/// the half that lies closer to the last point goes first. cost: O(N log N)
class SpatialOrder {
public:
    explicit SpatialOrder(std::span<const glm::dvec3> points) : points_(points) { order_.reserve(points.size()); }

    /// Appends `members` to the order, which they are taken out of.
    void append(std::span<std::uint32_t> members) {
        glm::dvec3 lo(0.0), hi(0.0);
        for (std::size_t i = 0; i < members.size(); ++i) {
            const glm::dvec3& p = points_[members[i]];
            lo = i == 0 ? p : (glm::min)(lo, p);
            hi = i == 0 ? p : (glm::max)(hi, p);
        }
        const glm::dvec3 size = hi - lo;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const double middle = 0.5 * (lo[axis] + hi[axis]);
        const auto high = std::partition(members.begin(), members.end(),
                                         [&](std::uint32_t i) { return points_[i][axis] <= middle; });
        const auto low_count = static_cast<std::size_t>(high - members.begin());
        if (low_count == members.size()) {  // one place
            std::sort(members.begin(), members.end());
            order_.insert(order_.end(), members.begin(), members.end());
            return;
        }
        const bool low_first = order_.empty() || points_[order_.back()][axis] <= middle;
        append(low_first ? members.first(low_count) : members.subspan(low_count));
        append(low_first ? members.subspan(low_count) : members.first(low_count));
    }
    const std::vector<std::uint32_t>& indices() const { return order_; }

private:
    std::span<const glm::dvec3> points_;
    std::vector<std::uint32_t> order_;
};

}  // namespace lightcuts::detail
