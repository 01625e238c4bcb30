#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "estimate.hpp"
#include "importance.hpp"

namespace lightcuts::detail {

/// A number chosen for a descent keeps its random bits as it is rescaled from node to node; below this probability too
/// few are left and it is drawn afresh.
inline constexpr double least_resolution = 0x1p-24;

/// Where in [0, 1) `u` lies within the part of length `length` that begins at `begin`.
inline double remainder_in(double u, double begin, double length) {
    const double r = (u - begin) / length;
    return r > 0.0 ? (std::min)(r, 1.0 - unit_roundoff) : 0.0;
}

/// Asks the processor for all cache lines of an object that will be read soon.
template <class T>
void prefetch(const T& object) {
#if defined(__GNUC__)
    constexpr std::size_t line = 64;
    const char* const first = reinterpret_cast<const char*>(&object);
    for (std::size_t at = 0; at < sizeof(T); at += line) __builtin_prefetch(first + at);
    __builtin_prefetch(first + sizeof(T) - 1);
#else
    static_cast<void>(object);
#endif
}

/// The same for the clusters of a node's children. pre: not a leaf.
template <class Tree>
void prefetch_children(const Tree& tree, std::uint32_t node) {
    prefetch(tree.clusters()[tree.topology().left(node)]);
    prefetch(tree.clusters()[tree.topology().right(node)]);
}

/// Shares the numbers of a visit out to the children of its node, into whose parts of [0, 1) they fall, and appends
/// those children that get some to `visits`. `part`: the children's probabilities.
template <class Visit>
void share_out(const Visit& visit, const ClusterTree& topology, const std::array<double, 2>& part,
               std::span<double> numbers, std::vector<Visit>& visits) {
    const std::uint32_t left = topology.left(visit.node), right = topology.right(visit.node);
    if (visit.end - visit.begin == 1) {
        // Without a branch on the number, which cannot be predicted.
        double& u = numbers[visit.begin];
        const bool to_right = !(u < part[0]);
        const double begin = to_right ? part[0] : 0.0, length = part[to_right ? 1 : 0];
        u = remainder_in(u, begin, length);
        const std::uint32_t child = to_right ? right : left;
        visits.push_back(
            {child, visit.begin, visit.end, visit.weight / length, visit.resolution * length, visit.by_power});
        prefetch(topology.words()[child]);
        return;
    }
    const std::span<double> own = numbers.subspan(visit.begin, visit.end - visit.begin);
    const auto middle = std::lower_bound(own.begin(), own.end(), part[0]);
    const auto split = visit.begin + static_cast<std::uint32_t>(middle - own.begin());
    const auto visit_child = [&](std::uint32_t child, std::uint32_t begin, std::uint32_t end, double before,
                                 double length) {
        if (begin == end) return;
        for (double& u : numbers.subspan(begin, end - begin)) u = remainder_in(u, before, length);
        visits.push_back({child, begin, end, visit.weight / length, visit.resolution * length, visit.by_power});
        prefetch(topology.words()[child]);
    };
    visit_child(left, visit.begin, split, 0.0, part[0]);
    visit_child(right, split, visit.end, part[0], part[1]);
}

/// Sends the random numbers of the scratch's visits down the tree: at each node a number chooses the child into whose
/// part of [0, 1) it falls, the parts being the children's probabilities, and goes on as its place within that part. So
/// what was stratified stays so. Numbers that meet at a leaf become one drawn light; those below whose node nothing can
/// contribute are dropped. `scratch.visits` says which of `numbers`, rising within [0, 1), start where. All go down by
/// one level before any goes down by the next, so that what they wait for in memory comes at once.
/// cost: two importances a node visited, however many numbers visit it; found for four nodes at a time.
template <class Tree, class M, class Policy>
void descend(const Tree& tree, std::uint32_t kind, const Receiver<M>& receiver, const Policy& policy,
             std::span<double> numbers, std::uint64_t seed, EstimateScratch<typename Tree::spectrum>& scratch) {
    const ClusterTree& topology = tree.topology();
    auto& visits = scratch.visits;
    auto& inner = scratch.inner_visits;
    const auto draw_afresh = [&](auto& visit) {
        const std::span<double> own = numbers.subspan(visit.begin, visit.end - visit.begin);
        for (std::size_t k = 0; k < own.size(); ++k) {
            own[k] = uniform01(hash_keys(seed, receiver.id, kind, visit.node, k));
        }
        std::sort(own.begin(), own.end());
        visit.resolution = 1.0;
    };
    std::array<std::uint32_t, parents_at_once> nodes;
    std::array<std::array<Importance, 2>, parents_at_once> children;
    while (!visits.empty()) {
        // Step 1: draw the lights that were reached.
        inner.clear();
        for (auto& visit : visits) {
            if (visit.begin == visit.end) {
                // No sample starts here.
            } else if (topology.is_leaf(visit.node)) {
                prefetch(tree.lights()[topology.item(visit.node)]);
                scratch.draws.push_back({topology.item(visit.node), kind, visit.weight * (visit.end - visit.begin)});
            } else {
                if (visit.resolution < least_resolution) draw_afresh(visit);
                inner.push_back(visit);
                prefetch_children(tree, visit.node);
            }
        }
        visits.clear();
        // Step 2: share out the numbers of compact clusters.
        const auto bounded = std::partition(inner.begin(), inner.end(), [](const auto& v) { return v.by_power; });
        for (auto visit = inner.begin(); visit != bounded; ++visit) {
            share_out(*visit, topology, power_shares(tree, visit->node), numbers, visits);
        }
        for (auto first = bounded; first != inner.end();) {
            // Step 3: bound the children of some of the other nodes side by side.
            const auto count = (std::min)(parents_at_once, static_cast<std::size_t>(inner.end() - first));
            for (std::size_t i = 0; i < count; ++i) nodes[i] = first[static_cast<std::ptrdiff_t>(i)].node;
            find_child_importances(policy, receiver, tree, std::span<const std::uint32_t>(nodes).first(count),
                                   children.data());
            // Step 4: share out their numbers.
            for (std::size_t i = 0; i < count; ++i, ++first) {
                const auto part = probabilities_of(children[i]);
                if (!any(part)) continue;
                first->by_power = is_even(tree, first->node, receiver.position, part);
                share_out(*first, topology, part, numbers, visits);
            }
        }
    }
}

/// The part of [0, 1) into which `u` falls, when the parts are `probabilities` long; `u` becomes its place within it.
/// pre: the probabilities sum to 1.
template <std::size_t N>
std::size_t choose(const std::array<double, N>& probabilities, double& u) {
    std::size_t chosen = 0;
    double begin = 0.0, end = 0.0;
    for (std::size_t i = 0; i < N; ++i) {
        if (!(probabilities[i] > 0.0)) continue;
        chosen = i;
        begin = end;
        end += probabilities[i];
        if (u < end) break;
    }
    u = remainder_in(u, begin, probabilities[chosen]);
    return chosen;
}

/// Appends rising random numbers, one in each of `count` equal parts of [0, 1).
template <class Draw>
void add_stratified(std::vector<double>& numbers, std::size_t count, Draw&& draw) {
    for (std::size_t k = 0; k < count; ++k) {
        numbers.push_back(remainder_in(static_cast<double>(k) + draw(k), 0.0, static_cast<double>(count)));
    }
}

/// radiance x weight, finite.
template <Spectrum S>
S weighted(const S& radiance, double weight) {
    return finite(make_spectrum<S>([&](int c) { return static_cast<double>(channel(radiance, c)) * weight; }));
}

/// What each of the scratch's drawn lights contributes if nothing shadows it, times its weight; into the scratch's
/// contributions. Those whose transfer is zero are left out.
template <class Forest, class M>
void find_contributions(const Forest& forest, const Receiver<M>& receiver,
                        EstimateScratch<typename Forest::spectrum>& scratch) {
    static_assert(Material<std::remove_cvref_t<M>>,
                  "a material needs evaluate(to_light) const, which returns a Spectrum");
    using S = typename Forest::spectrum;
    const auto& draws = scratch.draws;
    scratch.contributions.clear();
    LaneSpectra<S> transfer;
    for (std::size_t begin = 0; begin < draws.size();) {
        const std::uint32_t kind = draws[begin].kind;
        std::size_t end = begin + 1;
        while (end < draws.size() && end - begin < lane_count && draws[end].kind == kind) ++end;
        forest.visit(kind, [&](const auto& tree) {
            using L = typename std::remove_cvref_t<decltype(tree)>::light_type;
            const auto light_of = [&](int i) -> const L& {
                return tree.lights()[draws[begin + static_cast<std::size_t>(i)].light];
            };
            const int count = static_cast<int>(end - begin);
            unshadowed_transfer<L>(receiver, count, light_of, transfer);
            for (int i = 0; i < count; ++i) {
                const S radiance = finite_product(transfer[static_cast<std::size_t>(i)], S(intensity_of(light_of(i))));
                if (is_black(radiance)) continue;
                const auto& draw = draws[begin + static_cast<std::size_t>(i)];
                scratch.contributions.push_back({weighted(radiance, draw.weight), draw.light, kind});
            }
        });
        begin = end;
    }
}

/// The sum of those of the scratch's contributions that are visible. cost: a shadow ray each.
template <class Forest, class M, class Oracle>
Estimate<typename Forest::spectrum> sum_visible(const Forest& forest, const Receiver<M>& receiver, const Oracle& oracle,
                                                EstimateScratch<typename Forest::spectrum>& scratch) {
    using S = typename Forest::spectrum;
    using Contribution = typename EstimateScratch<S>::Contribution;
    Estimate<S> result;
    RadianceSum<S> sum;
    result.queries = ask(forest, receiver, oracle, scratch, std::span<const Contribution>(scratch.contributions),
                         [&](const Contribution& c, const auto& visibility) { sum.add_seen(c.radiance, visibility); });
    result.radiance = sum.value();
    return result;
}

/// The weighted sum over the scratch's drawn lights. Those whose transfer is zero cost no shadow ray.
template <class Forest, class M, class Oracle>
Estimate<typename Forest::spectrum> estimate_draws(const Forest& forest, const Receiver<M>& receiver,
                                                   const Oracle& oracle,
                                                   EstimateScratch<typename Forest::spectrum>& scratch) {
    find_contributions(forest, receiver, scratch);
    return sum_visible(forest, receiver, oracle, scratch);
}

}  // namespace lightcuts::detail
