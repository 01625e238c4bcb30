#pragma once

#include <glm/vec3.hpp>

#include "cone.hpp"
#include "dot_over_distance.hpp"
#include "lanes.hpp"
#include "offset_block.hpp"
#include "vectorized.hpp"

namespace lightcuts {

/// A cone of directions for each box of an OffsetBlock. Each block is filled once: with `set`, then
/// `finish`; or with `fill`.
struct ConeBlock {
    LaneVectors axis;
    alignas(32) Lanes cos;  ///< of the half-angle; above 1 for a cone of one direction
    alignas(32) Lanes sin;
    detail::LaneSupport support;  ///< of the axes over the boxes
    bool any_single = false;      ///< some cone is one direction
    bool any_wide = false;        ///< some is more

    bool is_single(int lane) const { return cos[lane] > 1.0f; }

    /// pre: 0 <= lane < lane_count; `cone` is not empty
    void set(int lane, const Cone& cone) {
        if (lightcuts::is_single(cone)) {
            set(lane, cone.axis);
        } else {
            axis.set(lane, cone.axis);
            cos[lane] = static_cast<float>(cos_half_angle(cone));
            sin[lane] = static_cast<float>(sin_half_angle(cone));
            any_wide = true;
        }
    }
    void set(int lane, const glm::vec3& direction) {
        axis.set(lane, direction);
        cos[lane] = 2.0f;
        sin[lane] = 0.0f;
        any_single = true;
    }

    /// Repeats the last of `count` cones in the lanes behind it. pre: 0 < count <= lane_count; `boxes` is finished
    LIGHTCUTS_VECTORIZED void finish(int count, const OffsetBlock& boxes) {
        detail::repeat_last(axis, count);
        detail::repeat_last(cos, count);
        detail::repeat_last(sin, count);
        detail::support(axis, boxes, support);
    }

    /// Sets one direction, or one cone, in every lane. pre: `boxes` is finished
    LIGHTCUTS_VECTORIZED void fill(const glm::vec3& direction, const OffsetBlock& boxes) {
        detail::broadcast(direction, axis);
        for (float& c : cos) c = 2.0f;
        detail::support(direction, boxes, support);
        any_single = true;
    }
    void fill(const Cone& cone, const OffsetBlock& boxes) {
        set(0, cone);
        finish(1, boxes);
    }
};

namespace detail {

/// Upper bounds of max(0, cos(max(0, theta - beta))), where theta is the angle from a cone's axis to any point of the
/// box beside it and beta the cone's half-angle. For one direction that is the largest numerator over the least
/// distance, whatever stands in other lanes; a tighter bound is formed jointly with other factors.
LIGHTCUTS_VECTORIZED inline void clamped_max_cosines(const ConeBlock& cones, const OffsetBlock& b, Lanes& cosines) {
    const LaneSupport& s = cones.support;
    for (int i = 0; i < lane_count; ++i) {
        const float most = larger(s.value[i] + s.noise[i], 0.0f) * b.inverse[i];
        cosines[i] = select(s.value[i] <= -s.noise[i], 0.0f, smaller(larger(most * 1.00001f, 1e-37f), 1.0f));
    }
    if (!cones.any_wide) return;
    alignas(32) Lanes front;
    max_dots_over_distance<1>(cones.axis, s, b, front);
    for (int i = 0; i < lane_count; ++i) {
        // Where all lies behind the axis the cosine is negative, and the largest is that of a far point.
        const float farthest2 = b.farthest2[i];
        const float most = s.value[i] + s.noise[i];
        const bool is_behind = larger(most, larger(farthest2 - 1e37f, 1e-30f - farthest2)) < 0.0f;
        // A box that holds the receiver has an infinite bound here.
        const float cosine = select(is_behind, larger(smaller(most, 0.0f) * inverse_sqrt(farthest2), -1.0f),
                                    smaller(front[i], 1.0f));
        const float sine2 = larger(1.0f - cosine * cosine, 0.0f) + 1e-6f;
        const float wide = cosine * cones.cos[i] + sine2 * inverse_sqrt(sine2) * (cones.sin[i] + 1e-6f);
        const float inside = select(cosine >= cones.cos[i], 1.0f, smaller(wide * 1.000002f, 1.0f));
        cosines[i] = select(cones.is_single(i), cosines[i], larger(inside, 0.0f));
    }
}

}  // namespace detail

}  // namespace lightcuts
