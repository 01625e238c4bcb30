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
      spheres_(make_tree(scene.sphere_points, options)), virtual_(make_tree(scene.virtual_lights, options)),
      volume_(make_tree(scene.volume_lights, options)) {}

InstantSceneLights::InstantSceneLights(const Scene& scene, const Options& options)
    : SceneLights(scene, options), omni_at_(make_tree(scene.at_instants.omni, options)),
      oriented_at_(make_tree(scene.at_instants.oriented, options)),
      spots_at_(make_tree(scene.at_instants.spots, options)),
      directional_at_(make_tree(scene.at_instants.directional, options)),
      spheres_at_(make_tree(scene.at_instants.sphere_points, options)),
      virtual_at_(make_tree(scene.at_instants.virtual_lights, options)),
      volume_at_(make_tree(scene.at_instants.volume_lights, options)),
      forest_(Forest::forest_type(omni_, oriented_, spots_, directional_, spheres_, virtual_, volume_, omni_at_,
                                  oriented_at_, spots_at_, directional_at_, spheres_at_, virtual_at_, volume_at_),
              static_cast<std::uint32_t>(scene.instants.size())) {}

}  // namespace render
