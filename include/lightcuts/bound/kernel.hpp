#pragma once

#include <cmath>
#include <limits>

#include <glm/vec3.hpp>

#include "../core/cosine.hpp"
#include "../core/joint.hpp"
#include "view.hpp"

namespace lightcuts {

namespace detail {

inline glm::dvec3 abs(const glm::dvec3& v) { return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}; }

/// The certificate of `max_power` at one s: a bound of (v.p)+ / |p|^K, and the s at which it would be exact if the
/// same coordinates of s v stayed clamped to the box.
template <int K>
struct Certificate {
    double bound;
    double next;

    Certificate(const glm::dvec3& v, double s, const ClusterView& view) {
        constexpr double k = K;
        const glm::dvec3 wanted = v * s;
        const glm::dvec3 q = clamp(wanted, view.box);
        const double q2 = dot(q, q);
        // With what rounding may hide of it: little at q, but seen from a nearest point much nearer it counts.
        const double noise = 8.0 * unit_roundoff * (q2 + k * dot(abs(wanted), abs(q)));
        const double deficit = larger(k * dot(wanted, q) - q2 + noise, 0.0);
        const double inverse = view.inverse_distance;
        if constexpr (K == 1) bound = (std::sqrt(q2) + deficit * inverse) / s;
        if constexpr (K == 2) bound = (1.0 + deficit * (inverse * inverse)) / (2.0 * s);
        if constexpr (K == 3) bound = (1.0 / std::sqrt(q2) + deficit * (inverse * inverse * inverse)) / (3.0 * s);

        const auto fixed = [](double x, double y) { return x == y ? 0.0 : x; };
        const glm::dvec3 fixed_q(fixed(q.x, wanted.x), fixed(q.y, wanted.y), fixed(q.z, wanted.z));
        const double fixed_q2 = dot(fixed_q, fixed_q);
        const double fixed_vq = dot(fixed_q, v);
        if constexpr (K == 1) {
            next = fixed_q2 / fixed_vq;
        } else {
            const auto loose = [](double vi, double x, double y) { return x == y ? vi : 0.0; };
            const glm::dvec3 free_v(loose(v.x, q.x, wanted.x), loose(v.y, q.y, wanted.y), loose(v.z, q.z, wanted.z));
            const double b = k * fixed_vq;
            const double root = std::sqrt(b * b + 4.0 * (k - 1.0) * dot(free_v, free_v) * fixed_q2);
            next = 2.0 * fixed_q2 / (b + root);
        }
    }
};

/// Upper bound of (v.p)+ / |p|^K from two certificates: at the centre of the box, and one step from there.
/// pre: `support` is of v and not behind; view.distance2 > 0.
template <int K>
double two_certificates(const glm::dvec3& v, const Support& support, const ClusterView& view) {
    constexpr double k = K;
    const double facing = dot(v, view.centre);
    const double most = support.value + support.noise;
    const double start = facing > 0.0 ? view.centre2 / (k * facing) : dot(view.reach, view.reach) / (k * most);
    const Certificate<K> first(v, start, view);
    const bool usable = first.next > 0x1p-500 && first.next < 0x1p500;
    const Certificate<K> second(v, usable ? first.next : start, view);
    double trivial = most * view.inverse_distance;  // the largest numerator over the least distance
    for (int i = 1; i < K; ++i) trivial *= view.inverse_distance;
    const double length = std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z);
    double slack = 16.0 * unit_roundoff * length;
    for (int i = 1; i < K; ++i) slack *= view.inverse_distance;
    return smaller(smaller(first.bound, second.bound), trivial) * (1.0 + 32.0 * unit_roundoff) + slack;
}

}  // namespace detail

/// Bounds of cosines, alone and over squared distances, in a fixed number of operations: the first of two stages.
/// Zero and infinite as the bounds of `ExactKernel`.
struct QuickKernel {
    /// Bounds (v.p)+ / |p|^K. cost: about 20 ns
    template <int K>
    static double power(const glm::dvec3& v, const ClusterView& view) {
        const detail::Support support = detail::support_of(v, view.box);
        if (detail::is_behind(support)) return 0.0;
        if (view.distance2 == 0.0) return K == 1 ? 1.0 + 1e-6 : std::numeric_limits<double>::infinity();
        return detail::two_certificates<K>(v, support, view);
    }

    /// Bounds (n.p)+ (u.p)+ / |p|^4 as `joint_bound` does, with the weight that is best at the centre of the box.
    /// cost: about 25 ns
    static double joint(const glm::dvec3& n, const glm::dvec3& u, const ClusterView& view) {
        const detail::Support support_n = detail::support_of(n, view.box);
        const detail::Support support_u = detail::support_of(u, view.box);
        if (detail::is_behind(support_n) || detail::is_behind(support_u)) return 0.0;
        if (view.distance2 == 0.0) return std::numeric_limits<double>::infinity();
        const double at_n = detail::dot(n, view.centre);
        const double at_u = detail::dot(u, view.centre);
        const double most_n = support_n.value + support_n.noise;
        const double most_u = support_u.value + support_u.noise;
        const double lambda2 = detail::clamp(at_n > 0.0 && at_u > 0.0 ? at_u / at_n : most_u / most_n, 0x1p-12, 0x1p12);
        const double lambda = std::sqrt(lambda2);
        const double mu = 1.0 / lambda;
        const glm::dvec3 v = n * (0.5 * lambda) + u * (0.5 * mu);
        const detail::Support support{0.5 * (lambda * support_n.value + mu * support_u.value),
                                      lambda * support_n.noise + mu * support_u.noise};
        const double bound = detail::two_certificates<2>(v, support, view);
        return bound * bound * (1.0 + 16.0 * unit_roundoff);
    }
};

/// The same, iterated until nearly exact.
struct ExactKernel {
    template <int K>
    static double power(const glm::dvec3& v, const ClusterView& view) {
        return max_power<K>(v, view.box, 2e-3).value;
    }
    static double joint(const glm::dvec3& n, const glm::dvec3& u, const ClusterView& view) {
        return joint_bound(n, u, view.box);
    }
};

namespace detail {

/// Upper bound of max(0, cos) between unit v and the lights.
template <class Kernel>
double front_cosine(const glm::dvec3& v, const ClusterView& view) {
    const double c = Kernel::template power<1>(v, view);
    return c < 1.0 ? c : 1.0;
}

/// The same for unit directions towards distant lights: v.p itself bounds the cosine too.
template <class Kernel>
double directional_cosine(const glm::dvec3& v, const ClusterView& view) {
    constexpr double longest = 1.0 + 2e-6;  // directions are floats, and the box is widened by their rounding
    const double c = front_cosine<Kernel>(v, view);
    if (!(c > 0.0)) return 0.0;
    const Support support = support_of(v, view.box);
    const double least = smaller(c, larger(support.value, 0.0) + support.noise) * longest;
    return least < 1.0 ? least : 1.0;
}

}  // namespace detail

}  // namespace lightcuts
