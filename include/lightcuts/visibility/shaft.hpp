#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

#include "../core/assertion.hpp"
#include "../core/box.hpp"
#include "oracle.hpp"

namespace lightcuts {

/// All that lies between a box of receivers and a box of lights: a convex set that holds every segment from one to the
/// other, or every ray from the first in a direction of a DirectionBox. Bounded by planes, outward by a slack that
/// exceeds the rounding of tests against them.
class Shaft {
public:
    /// pre: neither box is empty; coordinates are finite; no vector of a DirectionBox is zero. `reach`: no coordinate
    /// that is tested is larger by absolute value.
    Shaft(const Box& receivers, const Box& lights, double reach) : Shaft(receivers, lights, false, reach) {}
    Shaft(const Box& receivers, const DirectionBox& lights, double reach) : Shaft(receivers, lights.box, true, reach) {}

    /// Leaves out what is lower than both all receivers and all lights, or `least`, whichever is higher of these two:
    /// for where lights that are lower along `normal` need not be hidden. Distant lights count as no lower than the
    /// receivers. pre: `normal` is not zero; at most one such call
    void cut_below(const glm::vec3& normal, double least, const Box& receivers, const Box& lights) {
        lower_limit(normal, detail::smaller(lowest(receivers, glm::dvec3(normal)),
                                            detail::larger(lowest(lights, glm::dvec3(normal)), least)));
    }
    void cut_below(const glm::vec3& normal, double, const Box& receivers, const DirectionBox&) {
        lower_limit(normal, lowest(receivers, glm::dvec3(normal)));
    }

    /// The least dot(normal, x) in a box.
    static double lowest(const Box& box, const glm::dvec3& normal) { return -farthest(box, -normal); }

    /// Which planes a place is outside of, a bit each.
    using Outside = std::uint32_t;

    Outside outside(const glm::vec3& place) const {
        const double x = static_cast<double>(place.x), y = static_cast<double>(place.y),
                     z = static_cast<double>(place.z);
        Outside bits = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            bits |= static_cast<Outside>(x_[i] * x + y_[i] * y + z_[i] * z > limit_[i]) << i;
        }
        return bits;
    }

    /// False only if no point between `a` and `b` lies in the shaft, which are outside of these planes.
    bool may_hold(const glm::vec3& a, Outside outside_a, const glm::vec3& b, Outside outside_b) const {
        if ((outside_a & outside_b) != 0) return false;
        // The part between two planes, or one end, is in the shaft, unless other planes cut that off.
        if (outside_a == 0 || outside_b == 0) return true;
        double begin = 0.0, end = 1.0;
        for (Outside left = outside_a | outside_b; left != 0; left &= left - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(left));
            const double at_a = above(i, a), at_b = above(i, b);
            // Where sums are contracted this may be another rounding than that of `outside`.
            if ((at_a > 0.0) == (at_b > 0.0)) continue;
            if (at_a > 0.0) {
                begin = detail::larger(begin, at_a / (at_a - at_b));
            } else {
                end = detail::smaller(end, at_a / (at_a - at_b));
            }
        }
        return begin <= end;
    }
    bool may_hold(const glm::vec3& a, const glm::vec3& b) const { return may_hold(a, outside(a), b, outside(b)); }

private:
    /// Six sides of a box, at most four planes along each axis, and the horizon.
    static constexpr std::size_t most_planes = 19;

    Shaft(const Box& receivers, const Box& lights, bool distant, double reach)
        // 1e4 times the rounding of a plane's test, 1e-10 of the size of the scene.
        : slack_(1e-10 * reach) {
        LIGHTCUTS_ASSERT(!is_empty(receivers) && !is_empty(lights));
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 up(0.0);
            up[axis] = 1.0;
            const double lo = static_cast<double>(lights.lo[axis]), hi = static_cast<double>(lights.hi[axis]);
            if (!distant || hi <= 0.0) add(up, distant ? farthest(receivers, up) : farthest(receivers, lights, up));
            if (!distant || lo >= 0.0) add(-up, distant ? farthest(receivers, -up) : farthest(receivers, lights, -up));
            add_sides(receivers, lights, distant, (axis + 1) % 3, (axis + 2) % 3);
        }
    }

    /// The planes through an edge of each box that run along the third axis. What is seen along it are two rectangles
    /// and the lines that touch both, each in corners of the same name: those that are farthest in its direction.
    void add_sides(const Box& receivers, const Box& lights, bool distant, int x, int y) {
        const auto corner = [](const Box& box, int axis, double side) {
            return static_cast<double>(side > 0.0 ? box.hi[axis] : box.lo[axis]);
        };
        for (const double side_x : {-1.0, 1.0}) {
            for (const double side_y : {-1.0, 1.0}) {
                const double to_x = corner(lights, x, side_x), to_y = corner(lights, y, side_y);
                const double way_x = distant ? to_x : to_x - corner(receivers, x, side_x);
                const double way_y = distant ? to_y : to_y - corner(receivers, y, side_y);
                // Lines along an axis are sides of the boxes.
                if (!(way_x * side_x * (way_y * side_y) < 0.0)) continue;
                const double length = std::sqrt(way_x * way_x + way_y * way_y);
                if (!(length > 0.0)) continue;
                glm::dvec3 outward(0.0);
                outward[x] = side_x * std::fabs(way_y) / length;
                outward[y] = side_y * std::fabs(way_x) / length;
                if (distant && farthest(lights, outward) > 1e-12 * nearest_length(lights)) continue;
                add(outward, distant ? farthest(receivers, outward) : farthest(receivers, lights, outward));
            }
        }
    }

    /// Of the vectors of a box the length of the shortest.
    static double nearest_length(const Box& box) {
        return std::sqrt(min_distance2({glm::dvec3(box.lo), glm::dvec3(box.hi)}));
    }

    void lower_limit(const glm::vec3& normal, double least) {
        const double length = glm::length(glm::dvec3(normal));
        add(-glm::dvec3(normal) / length, -least / length);
    }

    static double farthest(const Box& box, const glm::dvec3& direction) {
        double sum = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            sum += direction[axis] * static_cast<double>(direction[axis] > 0.0 ? box.hi[axis] : box.lo[axis]);
        }
        return sum;
    }
    static double farthest(const Box& a, const Box& b, const glm::dvec3& direction) {
        return detail::larger(farthest(a, direction), farthest(b, direction));
    }

    void add(const glm::dvec3& outward, double limit) {
        LIGHTCUTS_ASSERT(count_ < most_planes);
        x_[count_] = outward.x;
        y_[count_] = outward.y;
        z_[count_] = outward.z;
        limit_[count_++] = limit + slack_;
    }

    /// How far a place is outside of plane `i`; negative inside. Rounded as in `outside`.
    double above(std::size_t i, const glm::vec3& place) const {
        return x_[i] * static_cast<double>(place.x) + y_[i] * static_cast<double>(place.y) +
               z_[i] * static_cast<double>(place.z) - limit_[i];
    }

    /// The inside is where dot(outward, x) <= limit; directions outward are unit vectors.
    std::array<double, most_planes> x_, y_, z_, limit_;
    std::size_t count_ = 0;
    double slack_;
};

}  // namespace lightcuts
