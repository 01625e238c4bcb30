#pragma once

#include <concepts>

namespace lightcuts {

/// Attenuation 1/d^2: the physical one, for which the tightest bounds hold. Takes no space in a light.
struct InverseSquare {
    friend constexpr bool operator==(InverseSquare, InverseSquare) = default;
};

/// Attenuation 1/(constant + linear d + quadratic d^2) [Miksik 2007, section 2.2.2].
/// pre: coefficients are not negative and not all zero.
struct PolynomialFalloff {
    float constant = 0;
    float linear = 0;
    float quadratic = 1;

    constexpr float operator()(float distance) const {
        return 1.0f / (constant + distance * (linear + distance * quadratic));
    }
    /// Largest value at distances >= `min_distance`.
    constexpr float upper_bound(float min_distance) const { return (*this)(min_distance); }

    /// A falloff that is nowhere smaller than `a` or `b`.
    friend constexpr PolynomialFalloff merge(PolynomialFalloff a, PolynomialFalloff b) {
        return {a.constant < b.constant ? a.constant : b.constant, a.linear < b.linear ? a.linear : b.linear,
                a.quadratic < b.quadratic ? a.quadratic : b.quadratic};
    }
};

/// What a cluster of lights with attenuation `Falloff` remembers of it: a falloff that is nowhere smaller than any
/// of theirs.
template <class Falloff>
struct FalloffEnvelope {
    Falloff falloff;

    /// Largest falloff at distances >= `min_distance`.
    constexpr float falloff_bound(float min_distance) const { return falloff.upper_bound(min_distance); }
    friend constexpr FalloffEnvelope merge(FalloffEnvelope a, FalloffEnvelope b) {
        return {merge(a.falloff, b.falloff)};
    }
};

}  // namespace lightcuts
