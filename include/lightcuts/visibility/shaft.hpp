#pragma once

#include <array>
#include <cmath>
#include <cstddef>

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
    /// receivers. pre: `normal` is not zero
    void cut_below(const glm::vec3& normal, double least, const Box& receivers, const Box& lights) {
        lower_limit(normal, detail::smaller(lowest(receivers, glm::dvec3(normal)),
                                            detail::larger(lowest(lights, glm::dvec3(normal)), least)));
    }
    void cut_below(const glm::vec3& normal, double, const Box& receivers, const DirectionBox&) {
        lower_limit(normal, lowest(receivers, glm::dvec3(normal)));
    }

    /// The least dot(normal, x) in a box.
    static double lowest(const Box& box, const glm::dvec3& normal) { return -farthest(box, -normal); }

    /// False only if no point between `a` and `b` lies in the shaft.
    bool may_hold(const glm::vec3& a, const glm::vec3& b) const {
        const glm::dvec3 from(a), to(b);
        double begin = 0.0, end = 1.0;
        for (std::size_t i = 0; i < count_; ++i) {
            const Plane& plane = planes_[i];
            const double at_from = detail::dot(plane.outward, from) - plane.limit;
            const double at_to = detail::dot(plane.outward, to) - plane.limit;
            if (at_from > 0.0 && at_to > 0.0) return false;
            if (at_from > 0.0) {
                begin = detail::larger(begin, at_from / (at_from - at_to));
            } else if (at_to > 0.0) {
                end = detail::smaller(end, at_from / (at_from - at_to));
            }
            if (begin > end) return false;
        }
        return true;
    }

private:
    /// The inside is where dot(outward, x) <= limit.
    struct Plane {
        glm::dvec3 outward;  ///< unit
        double limit;
    };

    /// Six sides of a box, two planes along each axis and the horizon; and some that are nearly the same as others.
    static constexpr std::size_t most_planes = 20;

    /// A corner of the rectangle that a box is in a coordinate plane.
    struct Corner {
        double x;
        double y;
    };

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

    /// The planes through an edge of each box that run along the third axis: what is seen along it are two rectangles
    /// and the lines that touch both.
    void add_sides(const Box& receivers, const Box& lights, bool distant, int x, int y) {
        const auto corner = [&](const Box& box, int i) {
            return Corner{static_cast<double>(i % 2 == 0 ? box.lo[x] : box.hi[x]),
                          static_cast<double>(i < 2 ? box.lo[y] : box.hi[y])};
        };
        // Of a box that is flat along an axis, two corners are one.
        const auto is_there = [&](const Box& box, int i) {
            return (i % 2 == 0 || box.lo[x] < box.hi[x]) && (i < 2 || box.lo[y] < box.hi[y]);
        };
        for (int i = 0; i < 4; ++i) {
            for (int k = 0; k < 4; ++k) {
                if (!is_there(receivers, i) || !is_there(lights, k)) continue;
                const Corner from = corner(receivers, i), to = corner(lights, k);
                const Corner way = distant ? to : Corner{to.x - from.x, to.y - from.y};
                const double length = std::hypot(way.x, way.y);
                // Lines along an axis are sides of the boxes.
                if (!(length > 0.0) || way.x == 0.0 || way.y == 0.0) continue;
                glm::dvec3 outward(0.0);
                for (const double side : {1.0, -1.0}) {
                    outward[x] = side * way.y / length;
                    outward[y] = -side * way.x / length;
                    const double here = outward[x] * from.x + outward[y] * from.y;
                    // A line that has a corner beyond it, by more than rounding, touches only one of them.
                    const double limit = distant ? farthest(receivers, outward) : farthest(receivers, lights, outward);
                    if (limit > here + 0.5 * slack_) continue;
                    if (distant && farthest(lights, outward) > 1e-12 * nearest_length(lights)) continue;
                    add(outward, limit);
                }
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
        if (count_ == most_planes) return;  // a wider shaft is a shaft too
        planes_[count_++] = {outward, limit + slack_};
    }

    std::array<Plane, most_planes> planes_;
    std::size_t count_ = 0;
    double slack_;
};

}  // namespace lightcuts
