#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <lightcuts/bound/attenuated.hpp>
#include <lightcuts/product/gather.hpp>

#include "bounding_box.hpp"
#include "interrupt.hpp"
#include "lights/scene_lights.hpp"
#include "options.hpp"
#include "rays/oracle.hpp"
#include "rays/ray_scene.hpp"
#include "scene.hpp"
#include "shader.hpp"
#include "shading_of_cut.hpp"
#include "surfaces/gather_lobes.hpp"

namespace render {

/// A virtual light adds at most this share of what the eye is adapted to [Multidimensional Lightcuts 2006, Eq. 14].
inline constexpr float largest_share = 1.0f / 200.0f;

/// The shader of make_multidimensional_shader for the kinds of light in `Forest`: of `Lights`, SceneLights or
/// InstantSceneLights.
template <class Lights, class Forest>
class PairShader final : public Shader {
public:
    PairShader(const Scene& scene, const RayScene& rays, std::unique_ptr<const Lights> lights, const Forest& forest,
               const Options& options)
        : scene_(scene), rays_(rays), lights_(std::move(lights)), forest_(forest),
          clamps_by_transfer_(options.clamp.is_automatic() && !options.clamping().is_automatic()),
          shows_instants_(options.has_aov("instants")) {
        product_.separate_points = options.method == "unified-cut";
        if (options.pair_sides == "sizes") product_.side_rule = lightcuts::SideRule::sizes;
        // A light of one instant is as many times as strong as there are instants, but lights few of a pixel's rays.
        if (scene.at_instants.virtual_count() > 0) {
            rays_apart_ = static_cast<float>(
                std::min<std::size_t>(scene.instants.size(), static_cast<std::size_t>(options.spp)));
        }
        product_.cut.error_ratio = options.error_ratio;
        if (options.is_given("--max-cut")) product_.cut.max_cut = options.max_cut;
        product_.cut.seed = options.seed;
        product_.cut.clamp = options.clamping();
        tree_.scene_diagonal = std::sqrt(lightcuts::diagonal2(bounding_box(scene.positions)));
        if constexpr (std::same_as<Lights, InstantSceneLights>) tree_.instants = forest.instants();
        adapt(options.adaptation.value_or(0.0f));
    }

    std::unique_ptr<Scratch> make_scratch() const override { return std::make_unique<PairScratch>(); }

    void adapt(float radiance) override {
        product_.cut.adaptation = radiance;
        float strongest = 0.0f;
        const auto look_at = [&](const auto& lights) {
            for (const auto& light : lights) {
                strongest = std::max({strongest, light.intensity.x, light.intensity.y, light.intensity.z});
            }
        };
        look_at(scene_.virtual_lights);
        look_at(scene_.at_instants.virtual_lights);
        // Lights in fog of strong asymmetry are so bright ahead that those on surfaces would be clamped to nothing.
        if (strongest == 0.0f) {
            look_at(scene_.volume_lights);
            look_at(scene_.at_instants.volume_lights);
        }
        if (clamps_by_transfer_ && radiance > 0.0f && strongest > 0.0f) {
            product_.cut.clamp.transfer = largest_share * radiance * rays_apart_ / strongest;
        }
    }

    bool shades_pixels() const override { return true; }

    Shading shade_pixel(std::span<const SurfacePoint> points, float share, Scratch& scratch) const override {
        Shading shading;
        shading.gather_points = 0;
        shading.instants = 0.0f;
        if (points.empty()) return shading;
        auto& own = static_cast<PairScratch&>(scratch);
        own.points.clear();
        for (const SurfacePoint& p : points) own.points.add(p, share, receiver_name(scene_, p));
        own.trees.build(own.points.diffuse, own.points.glossy, own.points.fog, tree_);
        lightcuts::ProductOptions product = product_;
        product.id = points.front().pixel;
        with_oracle(scene_, rays_, [&](const auto& oracle) {
            const lightcuts::AttenuatedBounds<lightcuts::UniformMedium, lightcuts::TwoStageBounds> bounds(
                scene_.fog.medium, own.points.shadow_offset);
            const auto result = lightcuts::gather(forest_, own.trees, oracle, own.pairs, product, bounds);
            shading = shading_of(result);
            shading.pairs = result.pairs;
        });
        shading.gather_points = static_cast<std::uint32_t>(own.trees.point_count());
        shading.instants = shows_instants_ ? mean_instants(own) : 1.0f;
        return shading;
    }

    void shade(std::span<const SurfacePoint> points, std::span<Shading> out, Scratch& scratch) const override {
        for (std::size_t i = 0; i < points.size() && !interrupted(); ++i) {
            SurfacePoint alone = points[i];
            alone.weight = glm::vec3(1.0f);
            out[i] = shade_pixel(std::span(&alone, 1), 1.0f, scratch);
        }
    }

private:
    struct PairScratch final : Scratch {
        GatherPoints points;
        lightcuts::GatherForest<DiffuseGatherPoint, GlossyGatherPoint, FogGatherPoint> trees;
        lightcuts::gather_scratch_of<Forest> pairs;
        std::vector<std::uint32_t> seen;  ///< for each instant, the last cluster that has it
    };

    /// Of the clusters of gather points on the last cut.
    float mean_instants(PairScratch& own) const {
        if (own.trees.point_count() < 2) return 1.0f;  // no pairs, but the point's lightcut
        own.seen.assign(std::max<std::size_t>(scene_.instants.size(), 1), 0);
        std::uint32_t clusters = 0;
        double instants = 0.0;
        own.pairs.refinement.for_each([&](const auto& pair) {
            ++clusters;
            own.trees.visit(pair.gather_kind, [&](const auto& tree) {
                for (auto n = tree.topology().left_leaf(pair.gather); n <= pair.gather; ++n) {
                    if (!tree.topology().is_leaf(n)) continue;
                    std::uint32_t& last = own.seen[tree.point(n).instant];
                    instants += last == clusters ? 0.0 : 1.0;
                    last = clusters;
                }
            });
        });
        return clusters > 0 ? static_cast<float>(instants / clusters) : 0.0f;
    }

    const Scene& scene_;
    const RayScene& rays_;
    std::unique_ptr<const Lights> lights_;
    const Forest& forest_;  ///< of `lights_`
    bool clamps_by_transfer_;
    bool shows_instants_;
    float rays_apart_ = 1.0f;  ///< one in so many of a pixel's eye rays is at the instant of a virtual light
    lightcuts::ProductOptions product_;
    lightcuts::GatherTreeOptions tree_;
};

}  // namespace render
