#pragma once

#include <cstdint>

#include <lightcuts/cut/forest.hpp>
#include <lightcuts/tree/light_tree.hpp>

#include "options.hpp"
#include "scene.hpp"

namespace render {

/// The light trees of a scene, one for each kind of light; those of absent kinds are empty and cost nothing.
class SceneLights {
public:
    using Forest =
        lightcuts::LightForest<lightcuts::OmniLight<>, lightcuts::OrientedPointLight<>, lightcuts::SpotLight<>,
                               lightcuts::DistantLight<>, lightcuts::SpherePointLight<>, VirtualLight>;
    static constexpr std::uint32_t sphere_kind = 4;

    /// `scene` must outlive this object. throws: lightcuts::invalid_input for a light that cannot be used.
    SceneLights(const Scene& scene, const Options& options);
    SceneLights(const SceneLights&) = delete;
    SceneLights& operator=(const SceneLights&) = delete;

    const Forest& forest() const { return forest_; }

private:
    lightcuts::LightTree<lightcuts::OmniLight<>> omni_;
    lightcuts::LightTree<lightcuts::OrientedPointLight<>> oriented_;
    lightcuts::LightTree<lightcuts::SpotLight<>> spots_;
    lightcuts::LightTree<lightcuts::DistantLight<>> directional_;
    lightcuts::LightTree<lightcuts::SpherePointLight<>> spheres_;
    lightcuts::LightTree<VirtualLight> virtual_;
    Forest forest_{omni_, oriented_, spots_, directional_, spheres_, virtual_};
};

}  // namespace render
