#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "../core/discrete_distribution.hpp"
#include "../core/invalid_input.hpp"
#include "emission.hpp"

namespace lightcuts {

/// The lights that particles start from, of any kinds; a view of the user's.
template <Light... Ls>
class ParticleSources {
public:
    static_assert(sizeof...(Ls) > 0);
    using spectrum = spectrum_of<std::tuple_element_t<0, std::tuple<Ls...>>>;
    static_assert((std::same_as<spectrum_of<Ls>, spectrum> && ...), "lights of one scene share one spectrum");

    explicit ParticleSources(const std::vector<Ls>&... lights) : lights_(lights...) {}
    explicit ParticleSources(std::span<const Ls>... lights) : lights_(lights...) {}

    static constexpr bool has_directional = (DirectionalLight<Ls> || ...);

    /// Calls `f(kind, span of lights)` for each kind.
    template <class F>
    void for_each(F&& f) const {
        std::apply(
            [&](const auto&... lights) {
                std::uint32_t kind = 0;
                (f(kind++, lights), ...);
            },
            lights_);
    }

private:
    std::tuple<std::span<const Ls>...> lights_;
};

namespace detail {

/// A particle that leaves its light.
template <Spectrum S>
struct EmittedParticle {
    EmittedRay ray;
    S power;  ///< channels add up to 1
};

/// Chooses where particles start, in proportion to what lights send into the scene.
template <class Sources>
class ParticleEmission {
public:
    using S = typename Sources::spectrum;

    /// throws: invalid_input naming the light whose intensity is negative or not finite, or if none emits.
    /// memory: 24 bytes a light, 4 kilobytes for each emission profile that differs from all others
    ParticleEmission(const Sources& sources, const Box& bounds) : sources_(sources), bounds_(bounds) {
        sources.for_each([&](std::uint32_t kind, const auto& lights) {
            first_.push_back(choice_.size());
            profiles_of_.emplace_back();
            for (std::size_t i = 0; i < lights.size(); ++i) {
                const auto intensity = intensity_of(lights[i]);
                const double power = channel_sum(intensity) * flux_factor_of(lights[i]);
                bool valid = power - power == 0.0;
                for (int c = 0; c < channels_of<S>; ++c) valid = valid && channel(intensity, c) >= 0.0f;
                if (!valid) {
                    LIGHTCUTS_THROW(invalid_input("virtual lights: light " + std::to_string(i) + " of kind " +
                                                  std::to_string(kind) +
                                                  " has a power that is negative or not finite"));
                }
                choice_.add(power);
            }
        });
        if (!(choice_.total() > 0.0)) {
            LIGHTCUTS_THROW(invalid_input("virtual lights: no light emits anything, so no particle starts"));
        }
        choice_.prepare();
    }
    ParticleEmission(const ParticleEmission&) = delete;
    ParticleEmission& operator=(const ParticleEmission&) = delete;

    /// Sum of channels, W.
    double power() const { return choice_.total(); }

    /// Calls `f(light, particle)`. `u`: which light; `uv`, `w`: which way.
    template <class F>
    void emit_ray(double u, const glm::dvec2& uv, double w, F&& f) const {
        const std::size_t at = choice_(u);
        sources_.for_each([&](std::uint32_t kind, const auto& lights) {
            if (at < first_[kind] || at - first_[kind] >= lights.size()) return;
            const std::size_t i = at - first_[kind];
            const auto& light = lights[i];
            const TabulatedEmission* profile = profiles_of_[kind].empty() ? nullptr : profiles_of_[kind][i];
            const auto intensity = intensity_of(light);
            const double sum = channel_sum(intensity);
            const S share = make_spectrum<S>([&](int c) { return static_cast<double>(channel(intensity, c)) / sum; });
            f(light, EmittedParticle<S>{emitted_ray(light, profile, bounds_, uv, w), share});
        });
    }

private:
    template <class L>
    double flux_factor_of(const L& light) {
        if constexpr (ProfiledLight<L>) {
            const TabulatedEmission* profile = &*profiles_.emplace(light).first;
            profiles_of_.back().push_back(profile);
            return profile->power();
        } else {
            return flux_factor(light, bounds_);
        }
    }

    const Sources& sources_;
    Box bounds_;
    DiscreteDistribution choice_;
    std::vector<std::size_t> first_;                                  ///< of each kind
    std::set<TabulatedEmission> profiles_;                            ///< lights often share one
    std::vector<std::vector<const TabulatedEmission*>> profiles_of_;  ///< by kind and light; empty for other kinds
};

}  // namespace detail
}  // namespace lightcuts
