#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "../core/rounding.hpp"
#include "../core/spectrum.hpp"
#include "../material/reflection_bound.hpp"
#include "cosine_lobe.hpp"
#include "geometric.hpp"
#include "view.hpp"

namespace lightcuts {

namespace detail {

/// `multiply_bounds` where a product may be no number.
template <Spectrum S>
[[gnu::noinline]] constexpr S multiply_infinite_bounds(const S& a, const S& b) {
    return make_spectrum<S>([&](int c) {
        const float x = channel(a, c), y = channel(b, c);
        return x > 0.0f && y > 0.0f ? x * y : 0.0f;
    });
}

/// Channel-wise product of two bounds, where 0 x infinity = 0.
template <Spectrum S>
[[gnu::always_inline]] constexpr S multiply_bounds(const S& a, const S& b) {
    const S product = a * b;
    const float sum = rough_sum(product);
    if (sum == sum) [[likely]]
        return product;
    return multiply_infinite_bounds(a, b);
}

/// `scale_bound` by a factor that float cannot hold.
template <Spectrum S>
[[gnu::noinline]] constexpr S scale_infinite_bound(const S& s, float factor) {
    return make_spectrum<S>([&](int c) { return channel(s, c) > 0.0f ? channel(s, c) * factor : 0.0f; });
}

/// spectrum x bound, where 0 x infinity = 0.
template <Spectrum S>
[[gnu::always_inline]] constexpr S scale_bound(const S& s, float bound) {
    // Covers rounding to float here and in products with it, and axes of nearly unit length.
    constexpr float slack = 1.0f + 1.2e-5f;
    const float factor = bound * slack;
    if (factor <= (std::numeric_limits<float>::max)()) [[likely]]
        return s * factor;
    return scale_infinite_bound(s, factor);
}
template <Spectrum S>
constexpr S scale_bound(const S& s, double bound) {
    return scale_bound(s, round_up(bound));
}

/// Says what a material lacks to be bounded.
template <class B, class S>
constexpr void require_bound() {
    static_assert(
        ReflectionBound<B, S>,
        "a material needs upper_bound(offsets) const, which returns the spectrum that evaluate(to_light) does; "
        "or a stated cap: Capped{material, cap}");
}

/// `reflection_bound`; if `Joint`, cosines at receiver and light together also where normals or axes differ.
template <bool Joint, class B, Light L>
spectrum_of<L> bound_reflection(const B& bound, const LightCluster<L>& cluster, const ClusterView& view) {
    using S = spectrum_of<L>;
    require_bound<B, S>();
    if constexpr (BoundsByComponents<B>) {
        S sum = black<S>();
        bound.for_each_component([&](const auto& part) { sum = sum + bound_reflection<Joint>(part, cluster, view); });
        return sum;
    } else if constexpr (BoundsByCosineLobe<B, S>) {
        const auto lobe = bound.cosine_lobe();
        if constexpr (Joint) {
            return scale_bound(S(lobe.scale), joint_cosine_lobe_bound(lobe.normal, cluster, view));
        } else {
            return scale_bound(S(lobe.scale), cosine_lobe_bound(lobe.normal, cluster, view));
        }
    } else if constexpr (BoundsDirections<B, S>) {
        const double geometric = geometric_bound(cluster, view);
        if (!(geometric > 0.0)) return black<S>();
        return scale_bound(S(bound.upper_bound(view.box)), geometric);
    }
}

/// Adds one bound over all lanes to `units`.
template <class B, Light L>
void add_reflection_bounds(const B& bound, const LightCluster<L>* const* clusters, int count, const Box& receivers,
                           ClusterBlock<L>& block, spectrum_of<L>* units) {
    using S = spectrum_of<L>;
    require_bound<B, S>();
    const auto same = [&](int) -> const Box& { return receivers; };
    if constexpr (BoundsByComponents<B>) {
        bound.for_each_component(
            [&](const auto& part) { add_reflection_bounds(part, clusters, count, receivers, block, units); });
    } else if constexpr (BoundsByCosineLobe<B, S>) {
        alignas(32) Lanes cosines;
        const auto lobe = bound.cosine_lobe();
        ConeBlock normals;
        normals.fill(lobe.normal, block);
        cosine_lobe_bounds(normals, clusters, count, same, block, cosines);
        for (int i = 0; i < count; ++i) units[i] = units[i] + scale_bound(S(lobe.scale), cosines[i]);
    } else if constexpr (BoundsDirections<B, S>) {
        alignas(32) Lanes geometric;
        geometric_bounds(clusters, count, same, block, geometric);
        LaneSpectra<S> reflected;
        if constexpr (QuicklyBoundsDirections<B, S>) bound.quick_upper_bounds(block, reflected);
        for (int i = 0; i < count; ++i) {
            if (!(geometric[i] > 0.0f)) continue;
            S& r = reflected[static_cast<std::size_t>(i)];
            if constexpr (!QuicklyBoundsDirections<B, S>) r = bound.upper_bound(view_of(*clusters[i], receivers).box);
            units[i] = units[i] + scale_bound(r, geometric[i]);
        }
    }
}

/// Calls f(lobe) for the cosine lobe of `bound` before which `skip` others stand; false if there is none. Lowers `skip`
/// by the lobes that it has seen.
template <Spectrum S, class B, class F>
bool visit_cosine_lobe(const B& bound, int& skip, const F& f) {
    bool found = false;
    if constexpr (BoundsByComponents<B>) {
        bound.for_each_component([&](const auto& part) { found = found || visit_cosine_lobe<S>(part, skip, f); });
    } else if constexpr (BoundsByCosineLobe<B, S>) {
        found = skip-- == 0;
        if (found) f(bound.cosine_lobe());
    }
    return found;
}

/// Calls f(part) for each part of `bound` that is no cosine lobe.
template <Spectrum S, class B, class F>
void visit_other_bounds(const B& bound, const F& f) {
    if constexpr (BoundsByComponents<B>) {
        bound.for_each_component([&](const auto& part) { visit_other_bounds<S>(part, f); });
    } else if constexpr (!BoundsByCosineLobe<B, S>) {
        f(bound);
    }
}

}  // namespace detail

/// Upper bound of reflection x geometric term of every light of the cluster at every receiver of a box, per unit
/// intensity, shadows apart: the product of the factors' bounds. `bound`: of every surface in the box.
template <class B, Light L>
spectrum_of<L> reflection_bound(const B& bound, const LightCluster<L>& cluster, const Box& receivers) {
    return detail::bound_reflection<false>(bound, cluster, detail::view_of(cluster, receivers));
}

/// As `reflection_bound`, but both cosines of diffuse surfaces and of diffuse emitters are bounded together also where
/// normals or axes differ.
template <class B, Light L>
spectrum_of<L> joint_reflection_bound(const B& bound, const LightCluster<L>& cluster, const Box& receivers) {
    return detail::bound_reflection<true>(bound, cluster, detail::view_of(cluster, receivers));
}

/// Quick bounds of up to `lane_count` clusters of one kind at one box of receivers, without iteration, in vector code:
/// units[i] for *clusters[i]. pre: 0 < count <= lane_count
template <class B, Light L>
void reflection_bounds(const B& bound, const LightCluster<L>* const* clusters, int count, const Box& receivers,
                       spectrum_of<L>* units) {
    detail::ClusterBlock<L> block(clusters, count, receivers);
    for (int i = 0; i < count; ++i) units[i] = black<spectrum_of<L>>();
    detail::add_reflection_bounds(bound, clusters, count, receivers, block, units);
}

/// Quick bounds of up to `lane_count` pairs of a cluster and a box of receivers: units[i] for *clusters[i] at the
/// receivers in *receivers[i], whose surfaces *bounds[i] bounds. Cosine lobes and geometric terms in vector code, other
/// bounds one by one. pre: 0 < count <= lane_count
template <class B, Light L>
void reflection_bounds(const B* const* bounds, const LightCluster<L>* const* clusters, int count,
                       const Box* const* receivers, spectrum_of<L>* units) {
    using S = spectrum_of<L>;
    detail::require_bound<B, S>();
    const auto box_of_lane = [&](int i) -> const Box& { return *receivers[i]; };
    detail::ClusterBlock<L> block(clusters, count, box_of_lane);
    for (int i = 0; i < count; ++i) units[i] = black<S>();
    for (int lobe = 0;; ++lobe) {
        ConeBlock normals;
        std::array<S, lane_count> scales;
        bool any = false;
        for (int i = 0; i < count; ++i) {
            int skip = lobe;
            const bool found = detail::visit_cosine_lobe<S>(*bounds[i], skip, [&](const auto& l) {
                normals.set(i, l.normal);
                scales[static_cast<std::size_t>(i)] = l.scale;
            });
            any = any || found;
            if (found) continue;
            normals.set(i, glm::vec3(0.0f, 0.0f, 1.0f));
            scales[static_cast<std::size_t>(i)] = black<S>();
        }
        if (!any) break;
        normals.finish(count, block);
        alignas(32) Lanes cosines;
        detail::cosine_lobe_bounds(normals, clusters, count, box_of_lane, block, cosines);
        for (int i = 0; i < count; ++i) {
            units[i] = units[i] + detail::scale_bound(scales[static_cast<std::size_t>(i)], cosines[i]);
        }
    }
    bool has_geometric = false;
    alignas(32) Lanes geometric;
    for (int i = 0; i < count; ++i) {
        detail::visit_other_bounds<S>(*bounds[i], [&](const auto& part) {
            if (!has_geometric) detail::geometric_bounds(clusters, count, box_of_lane, block, geometric);
            has_geometric = true;
            if (!(geometric[i] > 0.0f)) return;
            const S reflected = part.upper_bound(detail::view_of(*clusters[i], *receivers[i]).box);
            units[i] = units[i] + detail::scale_bound(reflected, geometric[i]);
        });
    }
}

}  // namespace lightcuts
