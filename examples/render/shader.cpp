#include "shader.hpp"

#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/estimate/adaptive_splitting.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/estimate/power.hpp>
#include <lightcuts/estimate/stochastic_lightcuts.hpp>
#include <lightcuts/estimate/tree_sampling.hpp>
#include <lightcuts/estimate/ward.hpp>

#include "interrupt.hpp"
#include "lights/scene_lights.hpp"
#include "multidimensional_shader.hpp"
#include "rays/oracle.hpp"
#include "surfaces/surface_material.hpp"

namespace render {

namespace {

using Forest = SceneLights::Forest;
using Receiver = lightcuts::Receiver<SurfaceMaterial>;

Receiver receiver_of(const Scene& scene, const SurfacePoint& p) {
    return {p.position, SurfaceMaterial(p), p.ray_origin, receiver_name(scene, p)};
}

/// `CutForest`: one of the forests of SceneLights.
template <class CutForest>
class LightcutShader final : public Shader {
public:
    LightcutShader(const Scene& scene, const RayScene& rays, std::unique_ptr<const SceneLights> lights,
                   const CutForest& forest, const Options& options)
        : scene_(scene), rays_(rays), lights_(std::move(lights)), forest_(forest) {
        cut_.error_ratio = options.error_ratio;
        cut_.max_cut = options.max_cut;
        cut_.adaptation = options.adaptation.value_or(0.0f);
        cut_.seed = options.seed;
        cut_.clamp = options.clamping();
    }

    std::unique_ptr<Scratch> make_scratch() const override { return std::make_unique<CutScratch>(); }

    void adapt(float radiance) override { cut_.adaptation = radiance; }

    void shade(std::span<const SurfacePoint> points, std::span<Shading> out, Scratch& scratch) const override {
        auto& own = static_cast<CutScratch&>(scratch);
        with_oracle(scene_, rays_, [&](const auto& oracle) {
            // Long streams of shadow rays against short-lived data: 16 receivers at a time stay in the cache.
            for (std::size_t begin = 0; begin < points.size() && !interrupted(); begin += group) {
                const std::size_t count = std::min(group, points.size() - begin);
                own.receivers.clear();
                for (const SurfacePoint& p : points.subspan(begin, count))
                    own.receivers.push_back(receiver_of(scene_, p));
                own.results.resize(count);
                lightcuts::shade(forest_, std::span<const Receiver>(own.receivers), oracle, std::span(own.results),
                                 own.cuts, cut_);
                for (std::size_t i = 0; i < count; ++i) out[begin + i] = shading_of(own.results[i]);
            }
        });
    }

private:
    static constexpr std::size_t group = 16;

    struct CutScratch final : Scratch {
        std::vector<Receiver> receivers;
        std::vector<lightcuts::CutResult<glm::vec3>> results;
        lightcuts::scratch_of<CutForest> cuts;
    };

    static Shading shading_of(const lightcuts::CutResult<glm::vec3>& result) {
        return {result.radiance, result.error_bound, result.clamp_threshold,
                result.cut_size, result.queries,     result.stop == lightcuts::StopReason::limit};
    }

    const Scene& scene_;
    const RayScene& rays_;
    std::unique_ptr<const SceneLights> lights_;
    const CutForest& forest_;  ///< of `lights_`
    lightcuts::LightcutOptions cut_;
};

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
                const Receiver receiver = receiver_of(scene_, points[i]);
                const auto estimate = method_(lights_.forest(), receiver, oracle, own);
                out[i] = {estimate.radiance, glm::vec3(0.0f),  estimate.clamp_threshold,
                          estimate.queries,  estimate.queries, false};
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
    if (options.method == "adaptive-splitting") {
        return std::make_unique<EstimateShader<AdaptiveSplitting>>(scene, rays, options);
    }
    if (options.method == "stochastic-lightcuts") {
        return std::make_unique<EstimateShader<StochasticLightcuts>>(scene, rays, options);
    }
    if (options.sums_pixels()) return make_multidimensional_shader(scene, rays, options);
    auto lights = std::make_unique<const SceneLights>(scene, options);
    const SceneLights& trees = *lights;
    return trees.visit([&]<class F>(const F& forest) -> std::unique_ptr<Shader> {
        return std::make_unique<LightcutShader<F>>(scene, rays, std::move(lights), forest, options);
    });
}

}  // namespace render
