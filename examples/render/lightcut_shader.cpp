#include "lightcut_shader.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <oneapi/tbb/parallel_for.h>
#include <lightcuts/cut/learned_visibility.hpp>
#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/cut/shade_in_groups.hpp>

#include "interrupt.hpp"
#include "lights/scene_lights.hpp"
#include "rays/oracle.hpp"
#include "rays/scene_proofs.hpp"
#include "shading_of_cut.hpp"
#include "surfaces/surface_receiver.hpp"
#include "tbb_executor.hpp"

namespace render {

namespace {

using Cut = lightcuts::CutResult<glm::vec3>;

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
        if (options.visibility_bounds == "off" || options.learn_visibility) return;
        proofs_ = std::make_unique<const SceneProofs>(scene, rays);
        use_.used = options.visibility_bounds == "on" && !proofs_->mesh().empty();
    }

    std::unique_ptr<Scratch> make_scratch() const override { return std::make_unique<CutScratch>(); }

    void adapt(float radiance) override { cut_.adaptation = radiance; }

    LearningCost learn(std::span<const SurfacePoint> pilots) override {
        std::vector<SurfaceReceiver> receivers;
        receivers.reserve(pilots.size());
        for (const SurfacePoint& p : pilots) receivers.push_back(receiver_of(scene_, p));
        with_oracle(scene_, rays_, [&](const auto& oracle) {
            const lightcuts::LearningOptions options{.cut = cut_};
            learned_.emplace(forest_, std::span<const SurfaceReceiver>(receivers), oracle, options, TbbExecutor{});
        });
        return {learned_->pilot_count(), learned_->rays()};
    }

    bool wants_pilot() const override { return proofs_ && !proofs_->mesh().empty() && !use_.used; }

    void try_out(std::span<const std::vector<SurfacePoint>> blocks) override {
        // Cuts that end at their limit cost less for being wrong: proofs are compared with cuts that seldom do.
        lightcuts::LightcutOptions longer = cut_;
        longer.max_cut *= 4;
        const double without = steps_of(blocks, [&](auto points, const auto& oracle, CutScratch& scratch) {
            shade_alone(points, oracle, scratch, longer);
        });
        const double with = steps_of(blocks, [&](auto points, const auto& oracle, CutScratch& scratch) {
            shade_with_proofs(points, oracle, scratch);
        });
        use_.used = with < without;
        if (without > 0.0) use_.pilot_ratio = with / without;
        if (!use_.used) proofs_.reset();
    }

    ProofUse proof_use() const override { return use_; }

    void shade(std::span<const SurfacePoint> points, std::span<Shading> out, Scratch& scratch) const override {
        auto& own = static_cast<CutScratch&>(scratch);
        with_oracle(scene_, rays_, [&](const auto& oracle) {
            const std::size_t most = use_.used ? sharing_at_once : at_once;
            for (std::size_t begin = 0; begin < points.size() && !interrupted(); begin += most) {
                const auto some = points.subspan(begin, std::min(most, points.size() - begin));
                if (use_.used) {
                    shade_with_proofs(some, oracle, own);
                } else if (learned_) {
                    shade_alone(some, lightcuts::LearnedOracle(oracle, *learned_), own, cut_);
                } else {
                    shade_alone(some, oracle, own, cut_);
                }
                for (std::size_t i = 0; i < some.size(); ++i) out[begin + i] = shading_of(own.results[i]);
            }
        });
    }

private:
    /// Long streams of shadow rays against short-lived data: so many receivers stay in the cache.
    static constexpr std::size_t at_once = 16;
    /// Neighbors for proofs are looked for among so many points: two tiles' or more.
    static constexpr std::size_t sharing_at_once = 512;

    struct CutScratch final : Scratch {
        std::vector<SurfaceReceiver> receivers;
        std::vector<Cut> results;
        lightcuts::GroupScratch<CutForest, SurfaceReceiver> groups;
    };

    void receive(std::span<const SurfacePoint> points, CutScratch& scratch) const {
        scratch.receivers.clear();
        for (const SurfacePoint& p : points) scratch.receivers.push_back(receiver_of(scene_, p));
        scratch.results.resize(points.size());
    }

    template <class Oracle>
    void shade_alone(std::span<const SurfacePoint> points, const Oracle& oracle, CutScratch& scratch,
                     const lightcuts::LightcutOptions& options) const {
        receive(points, scratch);
        lightcuts::shade(forest_, std::span<const SurfaceReceiver>(scratch.receivers), oracle,
                         std::span(scratch.results), scratch.groups.cuts, options);
    }

    template <class Oracle>
    void shade_with_proofs(std::span<const SurfacePoint> points, const Oracle& oracle, CutScratch& scratch) const {
        receive(points, scratch);
        lightcuts::shade_in_groups(forest_, std::span<const SurfaceReceiver>(scratch.receivers), oracle,
                                   proofs_->hidden(), std::span(scratch.results), scratch.groups, cut_);
    }

    /// What it takes to shade blocks of points by `shade_block(points, oracle, scratch)`.
    template <class ShadeBlock>
    double steps_of(std::span<const std::vector<SurfacePoint>> blocks, const ShadeBlock& shade_block) const {
        std::vector<double> steps(blocks.size());
        with_oracle(scene_, rays_, [&](const auto& oracle) {
            tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t b) {
                if (interrupted()) return;
                CutScratch scratch;
                shade_block(std::span<const SurfacePoint>(blocks[b]), oracle, scratch);
                steps[b] = steps_of(scratch);
            });
        });
        return std::accumulate(steps.begin(), steps.end(), 0.0);
    }

    /// What cuts and proofs took, in shadow rays; a cluster of a cut counts as one.
    static double steps_of(const CutScratch& scratch) {
        double steps = scratch.groups.steps().in_shadow_rays();
        for (const Cut& cut : scratch.results) {
            steps += static_cast<double>(cut.queries) + static_cast<double>(cut.cut_size);
        }
        return steps;
    }

    const Scene& scene_;
    const RayScene& rays_;
    std::unique_ptr<const SceneLights> lights_;
    const CutForest& forest_;  ///< of `lights_`
    std::unique_ptr<const SceneProofs> proofs_;
    ProofUse use_;
    lightcuts::LightcutOptions cut_;
    std::optional<lightcuts::LearnedVisibility> learned_;
};

}  // namespace

std::unique_ptr<Shader> make_lightcut_shader(const Scene& scene, const RayScene& rays, const Options& options) {
    auto lights = std::make_unique<const SceneLights>(scene, options);
    const SceneLights& trees = *lights;
    return trees.visit([&]<class F>(const F& forest) -> std::unique_ptr<Shader> {
        return std::make_unique<LightcutShader<F>>(scene, rays, std::move(lights), forest, options);
    });
}

}  // namespace render
