#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "../cut/clamp.hpp"
#include "../cut/forest.hpp"
#include "../cut/refinement.hpp"
#include "../shading/shadow_origin.hpp"
#include "../shading/transfer.hpp"
#include "../visibility/oracle.hpp"
#include "importance.hpp"

namespace lightcuts {

/// What shading a receiver light by light yields.
template <Spectrum S>
struct Estimate {
    S radiance = black<S>();
    /// Radiance that no clamped light exceeded; infinite if there was no limit, as in automatic clamping of two or
    /// fewer.
    S clamp_threshold = make_spectrum<S>([](int) { return std::numeric_limits<float>::infinity(); });
    std::uint32_t queries = 0;  ///< shadow rays asked of the oracle
};

/// Storage that the estimators reuse; one for each thread. No allocation once warm.
template <Spectrum S>
struct EstimateScratch {
    /// A light that would contribute if nothing shadowed it.
    struct Contribution {
        S radiance;
        std::uint32_t light;
        std::uint32_t kind;
    };
    /// A light drawn at random, and by what its contribution is multiplied: the inverse of its probability.
    struct Draw {
        std::uint32_t light;
        std::uint32_t kind;
        double weight;
    };
    /// A node that some of the random numbers have reached.
    struct Visit {
        std::uint32_t node;
        std::uint32_t begin, end;  ///< of the numbers
        double weight;             ///< of each number: divided by its probability to come here
        double resolution;         ///< that probability, counted from where the numbers were drawn
        bool by_power = false;     ///< lights below are drawn in proportion to intensity
    };
    /// A node from which lights are drawn, apart from the others.
    struct Stratum {
        std::uint32_t node;
        std::uint32_t kind;
        bool leaf;
        Importance importance;
        std::array<Importance, 2> children;  ///< importances of the node's; of a leaf, of no meaning
        double priority;
    };
    std::vector<Contribution> contributions;
    std::vector<double> sums;
    std::vector<double> numbers;
    std::vector<Visit> visits;
    std::vector<Visit> inner_visits;  ///< those of nodes that hold several lights
    std::vector<Draw> draws;
    std::vector<Stratum> strata;
    Refinement<Stratum> refinement;
    std::vector<S> clamped;  ///< contributions to which a threshold applies
    std::vector<VisibilityQuery> queries;
    std::vector<float> answers;
    std::vector<S> transmittances;  ///< answers that are spectra
};

namespace detail {

/// Calls `f(i, contribution)` for each of the lights that contributes if nothing shadows it: transfer x intensity. As
/// many at a time as a cut takes, so that both see the same values. `clamp`: of which the limit of transfer applies.
template <class M, Light L, class F>
void for_each_unshadowed(const Receiver<M>& receiver, std::span<const L> lights, F&& f,
                         [[maybe_unused]] const ClampingOptions& clamp = {}) {
    static_assert(Material<std::remove_cvref_t<M>>,
                  "a material needs evaluate(to_light) const, which returns a Spectrum");
    using S = spectrum_of<L>;
    LaneSpectra<S> transfer;
    for (std::size_t begin = 0; begin < lights.size(); begin += lane_count) {
        const std::span<const L> members = lights.subspan(begin,
                                                          std::min<std::size_t>(lane_count, lights.size() - begin));
        const auto light_of = [&](int i) -> const L& { return members[static_cast<std::size_t>(i)]; };
        unshadowed_transfer<L>(receiver, static_cast<int>(members.size()), light_of, transfer);
        for (std::size_t i = 0; i < members.size(); ++i) {
            if constexpr (ClampableLight<L>) transfer[i] = at_most(transfer[i], clamp.transfer);
            const S contribution = finite_product(transfer[i], S(intensity_of(members[i])));
            if (!is_black(contribution)) f(static_cast<std::uint32_t>(begin + i), contribution);
        }
    }
}

template <Spectrum S>
struct RadianceSum {
    ChannelSums<S> sum{};

    void add(const S& radiance, double weight) {
        for (int c = 0; c < channels_of<S>; ++c) {
            sum[static_cast<std::size_t>(c)] += static_cast<double>(channel(radiance, c)) * weight;
        }
    }
    /// What an oracle's answer, a float or a spectrum, lets through.
    template <class A>
    void add_seen(const S& radiance, const A& visibility) {
        if constexpr (std::same_as<A, float>) {
            add(radiance, static_cast<double>(visibility));
        } else {
            add(radiance * visibility, 1.0);
        }
    }
    S value() const {
        return finite(make_spectrum<S>([this](int c) { return sum[static_cast<std::size_t>(c)]; }));
    }
};

/// Asks the oracle about `contributions` and calls `take(contribution, visibility)` for each, in order; visibility is a
/// float or a spectrum. Returns the number of questions: none of AlwaysVisible.
template <class Forest, class M, class Oracle, Spectrum S, class Contribution, class Take>
std::uint32_t ask(const Forest& forest, const Receiver<M>& receiver, const Oracle& oracle, EstimateScratch<S>& scratch,
                  std::span<const Contribution> contributions, Take&& take) {
    static_assert(answers<Oracle, Receiver<M>, Forest>,
                  "an oracle needs operator()(receiver, light) const, which returns a bool, a fraction or "
                  "a spectrum of fractions, or many(queries, answers) const");
    if constexpr (std::same_as<Oracle, AlwaysVisible>) {
        for (const Contribution& c : contributions) take(c, 1.0f);
        return 0;
    } else if constexpr (AnswersMany<Oracle, S>) {
        scratch.queries.clear();
        for (const Contribution& c : contributions) {
            forest.visit(c.kind, [&](const auto& tree) {
                const auto& light = tree.lights()[c.light];
                using L = typename std::remove_cvref_t<decltype(tree)>::light_type;
                const glm::vec3 place = position_or_direction(light);
                scratch.queries.push_back({receiver.shadow_origin_towards(towards<L>(receiver.position, place)),
                                           receiver.id, place, c.light, c.kind, DirectionalLight<L>});
            });
        }
        const auto answers = ask_many(oracle, scratch.queries, answers_for<Oracle, S>(scratch));
        for (std::size_t i = 0; i < contributions.size(); ++i) take(contributions[i], answers[i]);
        return static_cast<std::uint32_t>(contributions.size());
    } else {
        for (const Contribution& c : contributions) {
            forest.visit(c.kind, [&](const auto& tree) {
                const auto& light = tree.lights()[c.light];
                with_shadow_origin(receiver, light,
                                   [&](const auto& lit) { take(c, as_factor<S>(oracle(lit, light))); });
            });
        }
        return static_cast<std::uint32_t>(contributions.size());
    }
}

}  // namespace detail

}  // namespace lightcuts
