#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <tuple>
#include <vector>

#include <glm/vec3.hpp>

#include "../core/assertion.hpp"
#include "../core/box.hpp"
#include "flood.hpp"

namespace lightcuts {

/// Receivers in groups of neighbors, those of one horizon together where there are enough of them: what SharedProofs
/// is started with. Reusable: no allocation once warm.
class ReceiverGroups {
public:
    /// Divides receivers into groups of at most `most`, anew. The same for the same receivers in the same order.
    /// pre: most >= 1; at most 2^32 - 1 receivers; no box is empty, and normals are numbers. cost: O(N log N)
    void divide(std::span<const ReceiverBox> receivers, std::size_t most) {
        LIGHTCUTS_ASSERT(most >= 1);
        order_.resize(receivers.size());
        std::iota(order_.begin(), order_.end(), std::uint32_t{0});
        groups_.clear();
        // Receivers of one horizon are neighbors in this order.
        const auto key = [&](std::uint32_t i) {
            const glm::vec3 normal = receivers[i].horizon ? receivers[i].horizon->normal : glm::vec3(0.0f);
            return std::tuple(normal.x, normal.y, normal.z, i);
        };
        std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
        mixed_.clear();
        for (std::size_t first = 0, last = 0; first < order_.size(); first = last) {
            while (last < order_.size() && has_same_horizon(receivers[order_[first]], receivers[order_[last]])) ++last;
            if (last - first >= fewest_alike) {
                halve(receivers, order_, first, last - first, most);
            } else {
                mixed_.insert(mixed_.end(), order_.begin() + static_cast<std::ptrdiff_t>(first),
                              order_.begin() + static_cast<std::ptrdiff_t>(last));
            }
        }
        if (!mixed_.empty()) halve(receivers, mixed_, 0, mixed_.size(), most);
    }

    std::size_t size() const { return groups_.size(); }

    /// The numbers of the group's receivers.
    std::span<const std::uint32_t> members(std::size_t group) const {
        const Group& g = groups_[group];
        return std::span(g.is_mixed ? mixed_ : order_).subspan(g.first, g.count);
    }

    /// All of them: where their shadow rays start, and the horizon that is that of each, if there is one.
    const ReceiverBox& box(std::size_t group) const { return groups_[group].box; }

private:
    /// Fewer receivers of one horizon are put together with others that are near.
    static constexpr std::size_t fewest_alike = 4;

    struct Group {
        bool is_mixed;  ///< its members are in `mixed_`, not in `order_`
        std::size_t first;
        std::size_t count;
        ReceiverBox box;
    };

    static bool has_same_horizon(const ReceiverBox& a, const ReceiverBox& b) {
        if (!a.horizon || !b.horizon) return !a.horizon && !b.horizon;
        return a.horizon->normal == b.horizon->normal;
    }

    static ReceiverBox merged(std::span<const ReceiverBox> receivers, std::span<const std::uint32_t> members) {
        ReceiverBox all = receivers[members.front()];
        for (const std::uint32_t i : members.subspan(1)) {
            const ReceiverBox& one = receivers[i];
            const bool alike = all.horizon && has_same_horizon(all, one);
            all.box = merge(all.box, one.box);
            if (alike) {
                all.horizon->positions = merge(all.horizon->positions, one.horizon->positions);
            } else {
                all.horizon.reset();
            }
        }
        return all;
    }

    /// Halves `count` of `all` by number along the longest axis until groups are small enough.
    void halve(std::span<const ReceiverBox> receivers, std::vector<std::uint32_t>& all, std::size_t first,
               std::size_t count, std::size_t most) {
        const std::span<std::uint32_t> members = std::span(all).subspan(first, count);
        if (count <= most) {
            groups_.push_back({&all == &mixed_, first, count, merged(receivers, members)});
            return;
        }
        Box box;
        for (const std::uint32_t i : members) box = merge(box, receivers[i].box);
        const glm::dvec3 size = extent(box);
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const auto place = [&](std::uint32_t i) {
            return std::tuple(receivers[i].box.lo[axis], receivers[i].box.hi[axis], i);
        };
        const std::size_t half = count / 2;
        std::nth_element(members.begin(), members.begin() + static_cast<std::ptrdiff_t>(half), members.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
        halve(receivers, all, first, half, most);
        halve(receivers, all, first + half, count - half, most);
    }

    std::vector<std::uint32_t> order_;
    std::vector<std::uint32_t> mixed_;  ///< of receivers with horizons that few have
    std::vector<Group> groups_;
};

}  // namespace lightcuts
