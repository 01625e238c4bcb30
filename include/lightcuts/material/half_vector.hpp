#pragma once

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "../core/assertion.hpp"
#include "../core/box.hpp"
#include "../core/cosine.hpp"
#include "../core/vector.hpp"
#include "../core/vectorized.hpp"
#include "direction_caps.hpp"

namespace lightcuts::detail {

/// alpha^2, kept from where lobes would overflow a float.
constexpr double squared_roughness(float alpha) {
    const auto a = static_cast<double>(alpha);
    return a > 1e-6 ? a * a : 1e-12;
}

/// What a half-vector model needs to know of a light's direction o, with h the normalized sum of o and the view i.
struct HalfVector {
    double cosine;  ///< n . o; if it is not positive, the rest means nothing
    double sin2;    ///< squared sine of the angle between n and h
    double facing;  ///< i . h, the cosine for Fresnel's term
};

/// Lower bounds of a HalfVector's sin2 and facing over the directions of one box.
struct HalfVectorRange {
    double sin2;
    double facing;
};

/// Lower bounds of a HalfVector's sin2 and facing, over the directions of each of several caps.
struct HalfVectorRanges {
    alignas(32) Lanes sin2;
    alignas(32) Lanes facing;
};

/// Normal n and view direction i of one receiver, and the ranges of half-vectors over boxes of offsets, after
/// [Walter 2005, Notes on the Ward BRDF]: the frame has z = i and n = (sin_n, 0, cos_n).
///
/// In it let o have the azimuth phi and the angle theta from i; then h = (t cos phi, t sin phi, 1) up to length, with
/// t = tan(theta / 2). n.h grows with cos phi and is unimodal in t, with its peak at t = tan_n cos phi.
class HalfVectorFrame {
public:
    /// pre: unit vectors
    HalfVectorFrame(const glm::vec3& normal, const glm::vec3& view)
        : normal_(glm::normalize(glm::dvec3(normal))), view_(glm::normalize(glm::dvec3(view))) {
        LIGHTCUTS_ASSERT(is_unit(normal) && is_unit(view));
        cos_n_ = glm::dot(normal_, view_);
        const glm::dvec3 aside = glm::cross(view_, normal_);
        sin_n_ = glm::length(aside);
        if (sin_n_ > 1e-12) {
            y_ = aside / sin_n_;
        } else {
            sin_n_ = 0.0;
            y_ = std::fabs(view_.x) < 0.5 ? glm::dvec3(0.0, view_.z, -view_.y) : glm::dvec3(view_.y, -view_.x, 0.0);
        }
        y_ = glm::normalize(y_ - view_ * glm::dot(view_, y_));
        x_ = glm::cross(y_, view_);
        tan_n_ = sin_n_ / cos_n_;
        mirror_ = glm::normalize(2.0 * cos_n_ * normal_ - view_);
    }

    const glm::dvec3& normal() const { return normal_; }
    const glm::dvec3& view() const { return view_; }
    /// n . i
    double cos_view() const { return cos_n_; }

    /// pre: `to_light` is a unit vector, within float rounding
    HalfVector of(const glm::vec3& to_light) const {
        const glm::dvec3 o(to_light);
        const double cosine = dot(normal_, o);
        if (!(cosine > 0.0)) return {0.0, 1.0, 0.0};
        // i as long as o, so that their sum halves the angle even where they are nearly opposite.
        const double length = 0.5 + 0.5 * dot(o, o);
        const glm::dvec3 h = o + view_ * length;
        const glm::dvec3 across = glm::cross(normal_, h);
        const double h2 = dot(h, h);
        if (!(h2 > 0.0)) return {0.0, 1.0, 0.0};  // o = -i on the horizon
        return {cosine, dot(across, across) / h2, 0.5 * std::sqrt(h2) * (2.0 - length)};
    }

    /// Over the directions of `b`, from exact ranges of azimuth and angle. Without `WithFacing` `facing` is 0.
    /// pre: cos_view() > 0
    /// cost: about 70 ns
    template <bool WithFacing>
    HalfVectorRange range_over(const OffsetBox& b) const {
        if (min_distance2(b) == 0.0) return {0.0, 0.0};
        double x[8], y[8];
        project(x_, b, x);
        project(y_, b, y);
        // The cotangents of the azimuth of the vertices on either side of n's plane; NaN on the axis.
        constexpr double infinity = std::numeric_limits<double>::infinity();
        double lefts[8], rights[8];
        for (int i = 0; i < 8; ++i) {
            const double cotangent = x[i] / std::fabs(y[i]);
            lefts[i] = y[i] < 0.0 ? -infinity : cotangent;
            rights[i] = y[i] < 0.0 ? cotangent : -infinity;
        }
        const double left = most_of(lefts);
        const double right = most_of(rights);
        // The box meets the half-plane of azimuth 0 iff an edge between the two sides crosses it, iff the sum of their
        // cotangents is not negative. Elsewhere the least azimuth is at a vertex.
        const bool is_crossed = !(left + right < 0.0);
        const double cot = clamp(left > right ? left : right, -1e150, 1e150);
        const double csc = std::sqrt(1.0 + cot * cot);
        const double cos_phi = is_crossed ? 1.0 : cot / csc;
        const double sin_phi = is_crossed ? 0.0 : 1.0 / csc;

        // cos theta takes every value between those at two vertices, so the box has the peak if its cosine is there;
        // else only the end of the range on the peak's side counts.
        double t = cos_phi > 0.0 ? tan_n_ * cos_phi : 0.0;
        const double peak = (1.0 - t * t) / (1.0 + t * t);
        const double peak2 = peak * std::fabs(peak);
        double z[8];
        double r2[8];
        project(view_, b, z);
        sum_combinations({b.lo.x * b.lo.x, b.lo.y * b.lo.y, b.lo.z * b.lo.z},
                         {b.hi.x * b.hi.x, b.hi.y * b.hi.y, b.hi.z * b.hi.z}, r2);
        double beyond[8];
        for (int i = 0; i < 8; ++i) beyond[i] = z[i] * std::fabs(z[i]) - peak2 * r2[i];
        const double lowest = least_of(z);
        double least_cosine = -2.0;
        if (most_of(beyond) < 0.0) {
            const double c = max_cosine(view_, b, 1e-14) + 16.0 * unit_roundoff;
            if (c < peak) t = half_tangent(c);
        } else if (least_of(beyond) > 0.0) {
            least_cosine = least_cosine_of(lowest, z, r2, b);
            if (least_cosine > peak) t = half_tangent(least_cosine);
        }
        double facing = 0.0;
        if constexpr (WithFacing) {
            if (least_cosine == -2.0) {
                // Fresnel's term hardly varies up to 100 degrees or so: there a crude bound of the angle does.
                const double crude = lowest / std::sqrt(lowest < 0.0 ? min_distance2(b) : max_distance2(b));
                least_cosine = crude > -0.25 ? crude : least_cosine_of(lowest, z, r2, b);
            }
            facing = cos_half(least_cosine);
        }
        return {least_sin2(t, cos_phi, sin_phi), facing};
    }

    /// Over caps of directions: looser, in float.
    /// pre: cos_view() > 0
    LIGHTCUTS_VECTORIZED void ranges_over(const DirectionCaps& caps, HalfVectorRanges& ranges) const {
        const glm::vec3 view(view_), x_axis(x_), y_axis(y_);
        const auto cos_n = static_cast<float>(cos_n_), sin_n = static_cast<float>(sin_n_);
        const auto tan_n = static_cast<float>(smaller(tan_n_, 1e30));
        alignas(32) Lanes to_mirror;
        clamped_max_cosines(glm::vec3(mirror_), caps, to_mirror);
        for (int i = 0; i < lane_count; ++i) {
            const float cx = caps.center[0][i], cy = caps.center[1][i], cz = caps.center[2][i];
            // Stereographic projection from -i takes o to (t cos phi, t sin phi), and caps to discs; here times `base`.
            const float base = caps.cos[i] + (view.x * cx + view.y * cy + view.z * cz);
            const float x = x_axis.x * cx + x_axis.y * cy + x_axis.z * cz;
            const float y = magnitude(y_axis.x * cx + y_axis.y * cy + y_axis.z * cz);
            const float radius = caps.sin[i] + 1e-6f;
            const float m2 = x * x + y * y;
            const float m = square_root(m2);
            // Turn the center's azimuth towards n's by that of the tangent to the disc.
            const float outside2 = m2 * 0.999998f - radius * radius;
            const float tangent = square_root(larger(outside2, 0.0f));
            const float reach = select(x > 0.0f, radius - y, -1.0f);  // of the half-plane of azimuth 0
            const bool is_apart = smaller(outside2, -reach) > 0.0f;
            const float scale = 1.0f / larger(m2, 1e-30f);
            const float cos_phi = select(is_apart, (x * tangent + y * radius) * scale, 1.0f);
            const float sin_phi = select(is_apart, (y * tangent - x * radius) * scale, 0.0f);
            const float inverse = 1.0f / larger(base, 1e-3f);
            const float noise = 6e-6f * inverse;
            const float nearest = larger(m - radius, 0.0f) * inverse * (1.0f - noise);
            const float farthest = (m + radius) * inverse * (1.0f + 1.1f * noise);
            const float peak = tan_n * larger(cos_phi, 0.0f);
            const float t = smaller(larger(peak, nearest), farthest);
            // Between n and h = (t cos phi, t sin phi, 1), less an angle of 1e-5.
            const float beside = t * sin_phi, before = cos_n * (t * cos_phi) - sin_n;
            const float from_range = (beside * beside + before * before) / (1.0f + t * t) * 0.999f - 1e-7f;
            // Another bound: h -> o at most doubles angles, so n and h are at least half as far apart as o and n's
            // image.
            const float from_mirror = 0.499999f - 0.5f * to_mirror[i];
            const bool is_usable = smaller(base - 1e-3f, caps.narrow[i] - 0.5f) > 0.0f;
            ranges.sin2[i] = select(is_usable, larger(larger(from_range, from_mirror), 0.0f), 0.0f);
            ranges.facing[i] = select(is_usable, larger(inverse_sqrt(1.0f + farthest * farthest) - 1e-6f, 0.0f), 0.0f);
        }
    }

private:
    /// x + y + z for each choice of x, y and z from `lo` and `hi`.
    static void sum_combinations(const glm::dvec3& lo, const glm::dvec3& hi, double (&at)[8]) {
        for (int i = 0; i < 8; ++i) {
            at[i] = ((i & 1) != 0 ? hi.x : lo.x) + ((i & 2) != 0 ? hi.y : lo.y) + ((i & 4) != 0 ? hi.z : lo.z);
        }
    }
    /// axis . p at the vertices of `b`.
    static void project(const glm::dvec3& axis, const OffsetBox& b, double (&at)[8]) {
        sum_combinations(axis * b.lo, axis * b.hi, at);
    }

    /// The extremes of numbers, except NaN: undefined cosines, of vertices at the origin or on the view's axis.
    static double most_of(const double (&a)[8]) {
        double most = -std::numeric_limits<double>::infinity();
        for (const double x : a) most = x > most ? x : most;
        return most;
    }
    static double least_of(const double (&a)[8]) {
        double least = std::numeric_limits<double>::infinity();
        for (const double x : a) least = x < least ? x : least;
        return least;
    }

    /// tan(theta / 2)
    static double half_tangent(double cos_theta) {
        const double c = clamp(cos_theta, -1.0, 1.0);
        return std::sqrt((1.0 - c) / (1.0 + c + 1e-300));
    }
    /// cos(theta / 2)
    static double cos_half(double cos_theta) { return std::sqrt(0.5 + 0.5 * clamp(cos_theta, -1.0, 1.0)); }

    /// Lower bound of i . o. Where no vertex lies behind the viewer's plane the least is at a vertex.
    double least_cosine_of(double lowest, const double (&z)[8], const double (&r2)[8], const OffsetBox& b) const {
        if (lowest < 0.0) return -lightcuts::clamped_max_cosine(-view_, b, 1e-14) - 16.0 * unit_roundoff;
        double squares[8];
        for (int i = 0; i < 8; ++i) squares[i] = z[i] * z[i] / r2[i];
        return std::sqrt(least_of(squares)) - 16.0 * unit_roundoff;
    }

    /// Squared sine between n and h = (t cos phi, t sin phi, 1), less what rounding here and in `of` may amount to: an
    /// angle of 2e-15 in o, which the tangential direction magnifies by sqrt(1 + t^2) / 2.
    double least_sin2(double t, double cos_phi, double sin_phi) const {
        const double h2 = 1.0 + t * t;
        const double beside = t * sin_phi;
        const double before = cos_n_ * (t * cos_phi) - sin_n_;
        const double sin2 = (beside * beside + before * before) / h2 * (1.0 - 1e-7) - 4e-23 * h2;
        return sin2 > 0.0 ? sin2 : 0.0;
    }

    glm::dvec3 normal_;
    glm::dvec3 view_;  ///< the frame's z
    glm::dvec3 mirror_;
    glm::dvec3 x_;
    glm::dvec3 y_;
    double cos_n_;
    double sin_n_;
    double tan_n_;
};

}  // namespace lightcuts::detail
