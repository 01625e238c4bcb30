#include "shader.hpp"

#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include <lightcuts/estimate/adaptive_splitting.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/estimate/power.hpp>
#include <lightcuts/estimate/resampled.hpp>
#include <lightcuts/estimate/stochastic_lightcuts.hpp>
#include <lightcuts/estimate/tree_sampling.hpp>
#include <lightcuts/estimate/ward.hpp>

#include "interrupt.hpp"
#include "lightcut_shader.hpp"
#include "lights/scene_lights.hpp"
#include "multidimensional_shader.hpp"
#include "rays/oracle.hpp"
#include "surfaces/surface_receiver.hpp"

namespace render {

namespace {

using Forest = SceneLights::Forest;

/// The methods that add lights up one by one: `Method(forest, receiver, oracle, scratch) -> Estimate`.
template <class Method>
class EstimateShader final : public Shader {
public:
    EstimateShader(const Scene& scene, const RayScene& rays, const Options& options)
        : scene_(scene), rays_(rays), lights_(scene, options), method_(lights_.forest(), options) {}

    std::unique_ptr<Scratch> make_scratch() const override { return std::make_unique<LightScratch>(); }

    void shade(std::span<const SurfacePoint> points, std::span<Shading> out, Scratch& scratch) const override {
        auto& own = static_cast<LightScratch&>(scratch).lights;
        with_oracle(scene_, rays_, [&](const auto& oracle) {
            for (std::size_t i = 0; i < points.size() && !interrupted(); ++i) {
                const SurfaceReceiver receiver = receiver_of(scene_, points[i]);
                const auto estimate = method_(lights_.forest(), receiver, oracle, own);
                out[i] = {};
                out[i].radiance = estimate.radiance;
                out[i].clamp_threshold = estimate.clamp_threshold;
                out[i].cut_size = out[i].shadow_rays = estimate.queries;
            }
        });
    }

private:
    struct LightScratch final : Scratch {
        lightcuts::EstimateScratch<glm::vec3> lights;
    };

    const Scene& scene_;
    const RayScene& rays_;
    SceneLights lights_;
    Method method_;
};

struct Exhaustive {
    Exhaustive(const Forest&, const Options& options) : clamp(options.clamping()) {}
    template <class R, class Oracle, class Scratch>
    auto operator()(const Forest& forest, const R& receiver, const Oracle& oracle, Scratch& scratch) const {
        return lightcuts::exhaustive(forest, receiver, oracle, scratch, clamp);
    }
    lightcuts::ClampingOptions clamp;
};

struct Ward {
    Ward(const Forest&, const Options& options) : threshold(options.ward_threshold) {}
    template <class R, class Oracle, class Scratch>
    auto operator()(const Forest& forest, const R& receiver, const Oracle& oracle, Scratch& scratch) const {
        return lightcuts::ward(forest, receiver, oracle, threshold, scratch);
    }
    float threshold;
};

/// What the sampling methods have in common.
struct Sampling {
    Sampling(const Forest&, const Options& options) : samples(options.samples), seed(options.seed) {}
    std::uint32_t samples;
    std::uint64_t seed;
};

struct Power : Sampling {
    Power(const Forest& forest, const Options& options) : Sampling(forest, options), distribution(forest) {}
    template <class R, class Oracle, class Scratch>
    auto operator()(const Forest& forest, const R& receiver, const Oracle& oracle, Scratch& scratch) const {
        return lightcuts::power_sampling(forest, distribution, receiver, oracle, samples, seed, scratch);
    }
    lightcuts::PowerDistribution distribution;
};

struct TreeSampling : Sampling {
    using Sampling::Sampling;
    template <class R, class Oracle, class Scratch>
    auto operator()(const Forest& forest, const R& receiver, const Oracle& oracle, Scratch& scratch) const {
        return lightcuts::tree_sampling(forest, receiver, oracle, samples, seed, scratch);
    }
};

struct Resampled : Sampling {
    Resampled(const Forest& forest, const Options& options)
        : Sampling(forest, options), resampling{options.samples, options.candidates} {}
    template <class R, class Oracle, class Scratch>
    auto operator()(const Forest& forest, const R& receiver, const Oracle& oracle, Scratch& scratch) const {
        return lightcuts::resampled_sampling(forest, receiver, oracle, resampling, seed, scratch);
    }
    lightcuts::ResamplingOptions resampling;
};

struct ResampledPower : Resampled {
    ResampledPower(const Forest& forest, const Options& options) : Resampled(forest, options), distribution(forest) {}
    template <class R, class Oracle, class Scratch>
    auto operator()(const Forest& forest, const R& receiver, const Oracle& oracle, Scratch& scratch) const {
        return lightcuts::resampled_sampling(forest, distribution, receiver, oracle, resampling, seed, scratch);
    }
    lightcuts::PowerDistribution distribution;
};

struct AdaptiveSplitting : Sampling {
    AdaptiveSplitting(const Forest& forest, const Options& options)
        : Sampling(forest, options), threshold(options.splitting_threshold) {}
    template <class R, class Oracle, class Scratch>
    auto operator()(const Forest& forest, const R& receiver, const Oracle& oracle, Scratch& scratch) const {
        return lightcuts::adaptive_splitting(forest, receiver, oracle, threshold, samples, seed, scratch);
    }
    float threshold;
};

struct StochasticLightcuts : Sampling {
    using Sampling::Sampling;
    template <class R, class Oracle, class Scratch>
    auto operator()(const Forest& forest, const R& receiver, const Oracle& oracle, Scratch& scratch) const {
        return lightcuts::stochastic_lightcuts(forest, receiver, oracle, samples, seed, scratch);
    }
};

}  // namespace

std::unique_ptr<Shader> make_shader(const Scene& scene, const RayScene& rays, const Options& options) {
    if (options.method == "exhaustive") return std::make_unique<EstimateShader<Exhaustive>>(scene, rays, options);
    if (options.method == "ward") return std::make_unique<EstimateShader<Ward>>(scene, rays, options);
    if (options.method == "power") return std::make_unique<EstimateShader<Power>>(scene, rays, options);
    if (options.method == "tree-sampling") return std::make_unique<EstimateShader<TreeSampling>>(scene, rays, options);
    if (options.method == "resampled") return std::make_unique<EstimateShader<Resampled>>(scene, rays, options);
    if (options.method == "resampled-power") {
        return std::make_unique<EstimateShader<ResampledPower>>(scene, rays, options);
    }
    if (options.method == "adaptive-splitting") {
        return std::make_unique<EstimateShader<AdaptiveSplitting>>(scene, rays, options);
    }
    if (options.method == "stochastic-lightcuts") {
        return std::make_unique<EstimateShader<StochasticLightcuts>>(scene, rays, options);
    }
    if (options.sums_pixels()) return make_multidimensional_shader(scene, rays, options);
    return make_lightcut_shader(scene, rays, options);
}

}  // namespace render
