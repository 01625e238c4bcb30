#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "../core/box.hpp"
#include "../tree/build/divide.hpp"
#include "../tree/build/longest_axis.hpp"
#include "../tree/cluster_tree.hpp"
#include "../tree/summary.hpp"

namespace lightcuts::detail {

/// A position with a normal; zero where there is none.
struct PilotPlace {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};
};

/// Places among which the ones nearest to another are found, in position and normal. Immutable once built.
class PilotPlaces {
public:
    /// One of the places, by its index.
    struct Neighbor {
        double distance2 = std::numeric_limits<double>::infinity();
        std::uint32_t place = 0xffff'ffffu;

        friend bool operator<(const Neighbor& a, const Neighbor& b) {
            return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.place < b.place;
        }
    };

    PilotPlaces() = default;

    /// `normal_length`: what one unit of a normal's coordinates counts for, in diagonals of the box of the positions.
    /// pre: positions are finite. cost: O(N log N)
    PilotPlaces(std::vector<PilotPlace> places, double normal_length) : places_(std::move(places)) {
        std::vector<PointItem> items;
        items.reserve(places_.size());
        for (const PilotPlace& p : places_) items.push_back({p.position, 1.0f});
        tree_ = divide(items, LongestAxis{});
        boxes_ = summarize(
            tree_,
            [&](std::uint32_t i) {
                return std::pair{box_of(places_[i].position), box_of(places_[i].normal)};
            },
            [](const auto& a, const auto& b) {
                return std::pair{merge(a.first, b.first), merge(a.second, b.second)};
            });
        const double extent2 = boxes_.empty() ? 0.0 : diagonal2(boxes_.back().first);
        normal_scale2_ = normal_length * normal_length * (extent2 > 0.0 ? extent2 : 1.0);
    }

    std::size_t size() const { return places_.size(); }
    bool empty() const { return places_.empty(); }
    std::span<const PilotPlace> places() const { return places_; }

    /// Fills `found` with the nearest places, the nearest first, those of lower index first where several are as near;
    /// returns how many there are. cost: O(log N) for few.
    std::size_t nearest(const PilotPlace& at, std::span<Neighbor> found) const {
        const std::size_t count = (std::min)(found.size(), places_.size());
        found = found.first(count);
        std::fill(found.begin(), found.end(), Neighbor{});
        if (count == 0) return 0;
        // LongestAxis halves: there are no deeper trees.
        std::array<std::pair<double, std::uint32_t>, 64> waiting;
        std::size_t waiting_count = 0;
        waiting[waiting_count++] = {distance2(at, tree_.root()), tree_.root()};
        while (waiting_count > 0) {
            auto [least, n] = waiting[--waiting_count];
            while (!(least > found.back().distance2)) {
                if (tree_.is_leaf(n)) {
                    insert({least, tree_.item(n)}, found);
                    break;
                }
                std::pair nearer{distance2(at, tree_.left(n)), tree_.left(n)};
                std::pair farther{distance2(at, tree_.right(n)), tree_.right(n)};
                if (farther.first < nearer.first) std::swap(nearer, farther);
                waiting[waiting_count++] = farther;
                least = nearer.first;
                n = nearer.second;
            }
        }
        return count;
    }

private:
    static double distance2(const glm::vec3& point, const Box& box) {
        double sum = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            const double x = static_cast<double>(point[axis]);
            const double lo = static_cast<double>(box.lo[axis]), hi = static_cast<double>(box.hi[axis]);
            const double d = x < lo ? lo - x : x > hi ? x - hi : 0.0;
            sum += d * d;
        }
        return sum;
    }
    /// From the nearest place that node `n` may hold.
    double distance2(const PilotPlace& at, std::uint32_t n) const {
        return distance2(at.position, boxes_[n].first) + normal_scale2_ * distance2(at.normal, boxes_[n].second);
    }

    static void insert(Neighbor neighbor, std::span<Neighbor> found) {
        for (Neighbor& f : found) {
            if (neighbor < f) std::swap(neighbor, f);
        }
    }

    std::vector<PilotPlace> places_;
    ClusterTree tree_;
    std::vector<std::pair<Box, Box>> boxes_;  ///< of the nodes: of positions, and of normals
    double normal_scale2_ = 1.0;
};

}  // namespace lightcuts::detail
