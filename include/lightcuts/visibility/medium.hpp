#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <span>
#include <type_traits>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "../core/assertion.hpp"
#include "../core/box.hpp"
#include "../core/rounding.hpp"
#include "../light/incidence.hpp"
#include "oracle.hpp"

namespace lightcuts {

/// What fills the space between receivers and lights and lets only a part of the light through: `transmittance(from,
/// to)` between two points and `transmittance_to_infinity(from, direction)`, floats in [0, 1].
template <class M>
concept Medium = requires(const M& medium, const glm::vec3& a, const glm::vec3& b) {
    { medium.transmittance(a, b) } -> std::convertible_to<float>;
    { medium.transmittance_to_infinity(a, b) } -> std::convertible_to<float>;
};

/// A medium that bounds what it lets through: `upper_bound(a, b)` is no smaller than the transmittance between any
/// point of box a and any of box b.
template <class M>
concept BoundedMedium = Medium<M> && requires(const M& medium, const Box& a, const Box& b) {
    { medium.upper_bound(a, b) } -> std::convertible_to<float>;
};

/// A medium of one extinction everywhere in a box, and none outside it: exp(-extinction x the way inside the box).
class UniformMedium {
public:
    /// Fills no space.
    UniformMedium() = default;
    /// `extinction`: per unit of length, >= 0, finite; 0: no medium.
    UniformMedium(float extinction, const Box& where) : extinction_(static_cast<double>(extinction)), where_(where) {
        LIGHTCUTS_ASSERT(extinction >= 0.0f && extinction - extinction == 0.0f);
    }

    bool is_there() const { return extinction_ > 0.0; }
    float extinction() const { return static_cast<float>(extinction_); }
    /// The box that it fills; empty if there is none.
    const Box& where() const { return where_; }

    float transmittance(const glm::vec3& from, const glm::vec3& to) const {
        if (!is_there()) return 1.0f;
        const glm::dvec3 way = glm::dvec3(to) - glm::dvec3(from);
        return through(share_inside(glm::dvec3(from), way, 1.0) * glm::length(way));
    }
    /// `direction`: unit.
    float transmittance_to_infinity(const glm::vec3& from, const glm::vec3& direction) const {
        if (!is_there()) return 1.0f;
        return through(share_inside(glm::dvec3(from), glm::dvec3(direction), infinity));
    }
    /// The largest transmittance between a point of `a` and one of `b`; 1 unless both lie in the medium.
    float upper_bound(const Box& a, const Box& b) const {
        if (!is_there() || !contains(where_, a) || !contains(where_, b)) return 1.0f;
        const double least = std::sqrt(min_distance2(offsets(b, a)));
        const float bound = round_up(std::exp(-extinction_ * least) * (1.0 + 1e-6));
        return bound < 1.0f ? bound : 1.0f;
    }
    /// The way along a ray inside the medium, until `end` units of `direction`.
    double way_inside(const glm::vec3& from, const glm::vec3& direction, double end) const {
        return share_inside(glm::dvec3(from), glm::dvec3(direction), end) * glm::length(glm::dvec3(direction));
    }
    /// Where, in units of `direction`, a ray enters the medium that is on its way; 0 if it begins inside.
    double way_before(const glm::vec3& from, const glm::vec3& direction) const {
        return range(glm::dvec3(from), glm::dvec3(direction), infinity).begin;
    }

private:
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    struct Range {
        double begin;
        double end;
    };

    float through(double way) const { return static_cast<float>(std::exp(-extinction_ * way)); }

    double share_inside(const glm::dvec3& from, const glm::dvec3& way, double end) const {
        if (!is_there()) return 0.0;
        const Range r = range(from, way, end);
        return r.end > r.begin ? r.end - r.begin : 0.0;
    }

    /// Of from + t way the t in [0, end] for which it lies in the box.
    Range range(const glm::dvec3& from, const glm::dvec3& way, double end) const {
        Range r{0.0, end};
        for (int axis = 0; axis < 3; ++axis) {
            const double lo = static_cast<double>(where_.lo[axis]) - from[axis];
            const double hi = static_cast<double>(where_.hi[axis]) - from[axis];
            if (way[axis] == 0.0) {
                if (lo > 0.0 || hi < 0.0) return {0.0, 0.0};
                continue;
            }
            const double s = lo / way[axis], t = hi / way[axis];
            const double in = s < t ? s : t, out = s < t ? t : s;
            r.begin = in > r.begin ? in : r.begin;
            r.end = out < r.end ? out : r.end;
        }
        return r;
    }

    double extinction_ = 0.0;
    Box where_{};
};

/// Multiplies answers to shadow rays, floats or spectra, by the transmittance along each.
template <Medium M, class A>
void attenuate(const M& medium, std::span<const VisibilityQuery> queries, std::span<A> answers) {
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const VisibilityQuery& q = queries[i];
        answers[i] = answers[i] *
                     (q.distant ? medium.transmittance_to_infinity(q.from, q.to) : medium.transmittance(q.from, q.to));
    }
}

namespace detail {

/// `many` through a medium, for oracles that have it: a type of its own, as a name that exists but cannot be called is
/// taken for a mistake.
template <class Self, class Oracle>
class ManyThroughMedium {
public:
    template <class A>
    void many(std::span<const VisibilityQuery> queries, std::span<A> answers) const requires
        requires(const Oracle& oracle) {
        oracle.many(queries, answers);
    }
    {
        const Self& self = static_cast<const Self&>(*this);
        self.oracle_.many(queries, answers);
        attenuate(self.medium_, queries, answers);
    }
};
template <class Oracle>
struct NothingMany {};

}  // namespace detail

/// An oracle that sees through a medium: the answers of `oracle`, one by one or many at once, times the transmittance
/// from where the shadow ray starts to the light. Refers to both. What `oracle` says of whole clusters is not asked.
template <class Oracle, Medium M>
class ThroughMedium : public std::conditional_t<detail::has_many<Oracle>() || BatchedOracle<Oracle>,
                                                detail::ManyThroughMedium<ThroughMedium<Oracle, M>, Oracle>,
                                                detail::NothingMany<Oracle>> {
public:
    ThroughMedium(const Oracle& oracle, const M& medium) : oracle_(oracle), medium_(medium) {}
    /// It would refer to what is gone.
    ThroughMedium(const Oracle&&, const M&) = delete;
    ThroughMedium(const Oracle&, const M&&) = delete;
    ThroughMedium(const Oracle&&, const M&&) = delete;

    template <class R, Light L>
        requires ScalarOracle<Oracle, R, L>
    auto operator()(const R& receiver, const L& light) const {
        const glm::vec3 place = position_or_direction(light);
        const float left = DirectionalLight<L> ? medium_.transmittance_to_infinity(receiver.shadow_origin, place)
                                               : medium_.transmittance(receiver.shadow_origin, place);
        using Answer = decltype(oracle_(receiver, light));
        if constexpr (std::convertible_to<Answer, float>) {
            return left > 0.0f ? static_cast<float>(oracle_(receiver, light)) * left : 0.0f;
        } else {
            return oracle_(receiver, light) * left;
        }
    }

private:
    friend detail::ManyThroughMedium<ThroughMedium, Oracle>;

    const Oracle& oracle_;
    const M& medium_;
};

}  // namespace lightcuts
