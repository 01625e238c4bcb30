#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

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
    Flight flight;
    S power;  ///< channels add up to 1
};

/// Chooses where particles start, in proportion to what lights send into the scene.
template <class Sources>
class ParticleEmission {
public:
    using S = typename Sources::spectrum;

    /// throws: invalid_input naming the light whose intensity is negative or not finite, or if none emits
    ParticleEmission(const Sources& sources, const Box& bounds) : sources_(sources), bounds_(bounds) {
        double sum = 0.0;
        sources.for_each([&](std::uint32_t kind, const auto& lights) {
            first_.push_back(cumulative_.size());
            for (std::size_t i = 0; i < lights.size(); ++i) {
                const auto intensity = intensity_of(lights[i]);
                const double power = channel_sum(intensity) * flux_factor(lights[i], bounds);
                bool valid = power - power == 0.0;
                for (int c = 0; c < channels_of<S>; ++c) valid = valid && channel(intensity, c) >= 0.0f;
                if (!valid) {
                    throw invalid_input("virtual lights: light " + std::to_string(i) + " of kind " +
                                        std::to_string(kind) + " has a power that is negative or not finite");
                }
                sum += power;
                cumulative_.push_back(sum);
            }
        });
        if (!(sum > 0.0)) throw invalid_input("virtual lights: no light emits anything, so no particle starts");
    }

    /// Sum of channels, W.
    double power() const { return cumulative_.back(); }

    /// Calls `f(light, particle)`. `u`: which light; `uv`, `w`: which way.
    template <class F>
    void emit(double u, const glm::dvec2& uv, double w, F&& f) const {
        auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), u * power());
        if (found == cumulative_.end()) {  // rounding: the last light that emits
            found = std::lower_bound(cumulative_.begin(), cumulative_.end(), power());
        }
        const auto at = static_cast<std::size_t>(found - cumulative_.begin());
        sources_.for_each([&](std::uint32_t kind, const auto& lights) {
            if (at < first_[kind] || at - first_[kind] >= lights.size()) return;
            const auto& light = lights[at - first_[kind]];
            const auto intensity = intensity_of(light);
            const double sum = channel_sum(intensity);
            const S share = make_spectrum<S>([&](int c) { return static_cast<double>(channel(intensity, c)) / sum; });
            f(light, EmittedParticle<S>{flight_from(light, bounds_, uv, w), share});
        });
    }

private:
    const Sources& sources_;
    Box bounds_;
    std::vector<double> cumulative_;
    std::vector<std::size_t> first_;  ///< of each kind
};

}  // namespace detail
}  // namespace lightcuts
