#pragma once

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "../core/box.hpp"
#include "../core/cosine.hpp"
#include "direction_cap.hpp"

namespace lightcuts::detail {

/// alpha^2, kept from where lobes would overflow a float.
constexpr double squared_roughness(float alpha) {
    const auto a = static_cast<double>(alpha);
    return a > 1e-6 ? a * a : 1e-12;
}

/// What a half-vector model needs to know of a light's direction o, with h the normalised sum of o and the view i.
struct HalfVector {
    double cosine;  ///< n . o; if it is not positive, the rest means nothing
    double sin2;    ///< squared sine of the angle between n and h
    double facing;  ///< i . h, the cosine for Fresnel's term
};

/// Lower bounds of the same over many directions.
struct HalfVectorRange {
    double sin2;
    double facing;
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

    /// Over a cap of directions: looser, without iteration.
    /// pre: cos_view() > 0; the cap is narrow
    /// cost: about 20 ns
    HalfVectorRange range_over(const DirectionCap& cap) const {
        const double base = cap.along + dot(view_, cap.centre);
        if (!(base > 0.0 && base * base > 1e-24 * cap.d2)) return {0.0, 0.0};
        // Stereographic projection from -i takes o to (t cos phi, t sin phi), and caps to discs; here times `base`.
        const double x = dot(x_, cap.centre);
        const double y = std::fabs(dot(y_, cap.centre));
        const double radius = cap.across;
        const double m2 = x * x + y * y;
        const double m = std::sqrt(m2);
        const double outside2 = m2 * (1.0 - 32.0 * unit_roundoff) - radius * radius;
        double cos_phi = 1.0;
        double sin_phi = 0.0;
        if (outside2 > 0.0 && !(x > 0.0 && y <= radius)) {
            // Turn the centre's azimuth towards n's by that of the tangent to the disc.
            const double tangent = std::sqrt(outside2);
            cos_phi = (x * tangent + y * radius) / m2;
            sin_phi = (y * tangent - x * radius) / m2;
        }
        const double nearest = m > radius ? (m - radius) / base : 0.0;
        const double farthest = (m + radius) / base;
        const double t = clamp(cos_phi > 0.0 ? tan_n_ * cos_phi : 0.0, nearest, farthest);
        // Another bound: h -> o at most doubles angles, so n and h are at least half as far apart as o and n's image.
        const double apart = 0.5 - 0.5 * clamped_max_cosine(mirror_, cap);
        const double sin2 = least_sin2(t, cos_phi, sin_phi);
        return {apart > sin2 ? apart : sin2, 1.0 / std::sqrt(1.0 + farthest * farthest)};
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
