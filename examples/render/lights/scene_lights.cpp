#include "lights/scene_lights.hpp"

#include <lightcuts/tree/build/agglomerate.hpp>
#include <lightcuts/tree/build/longest_axis.hpp>

#include "tbb_executor.hpp"

namespace render {

namespace {

template <class L, class Builder>
lightcuts::LightTree<L> tree_with(const std::vector<L>& lights, const Options& options, const Builder& builder) {
    return lightcuts::LightTree<L>(lights, {.representatives = options.representatives, .seed = options.seed}, builder,
                                   TbbExecutor{});
}

template <class L>
lightcuts::LightTree<L> make_tree(const std::vector<L>& lights, const Options& options) {
    if (options.builder == "agglomerate") {
        return tree_with(lights, options,
                         [](auto items, const auto& execute) { return lightcuts::agglomerate(items, {}, execute); });
    }
    if (options.builder == "longest-axis") {
        return tree_with(lights, options, [](auto items, const auto& execute) {
            return lightcuts::divide(items, lightcuts::LongestAxis{}, execute);
        });
    }
    return tree_with(lights, options, lightcuts::BinnedBuilder{});
}

}  // namespace

SceneLights::SceneLights(const Scene& scene, const Options& options)
    : omni_(make_tree(scene.omni, options)), oriented_(make_tree(scene.oriented, options)),
      spots_(make_tree(scene.spots, options)), directional_(make_tree(scene.directional, options)),
      spheres_(make_tree(scene.sphere_points, options)), virtual_(make_tree(scene.virtual_lights, options)) {}

}  // namespace render
