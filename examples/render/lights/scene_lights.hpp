#pragma once

#include <cstdint>

#include <lightcuts/cut/forest.hpp>
#include <lightcuts/tree/light_tree.hpp>

#include "options.hpp"
#include "scene.hpp"

namespace render {

/// The kinds of light that any scene may have, and `More`.
template <class... More>
using ForestWith =
    lightcuts::LightForest<lightcuts::OmniLight<>, lightcuts::OrientedPointLight<>, lightcuts::SpotLight<>,
                           lightcuts::DistantLight<>, lightcuts::SpherePointLight<>, More...>;

/// The light trees of a scene, one for each kind of light; those of absent kinds are empty and cost nothing.
class SceneLights {
public:
    using DirectForest = ForestWith<>;
    using Forest = ForestWith<lightcuts::VirtualPointLight<>>;
    static constexpr std::uint32_t oriented_kind = 1;
    static constexpr std::uint32_t sphere_kind = 4;
    static constexpr std::uint32_t virtual_kind = 5;

    /// `scene` must outlive this object. throws: lightcuts::invalid_input for a light that cannot be used.
    SceneLights(const Scene& scene, const Options& options);
    SceneLights(const SceneLights&) = delete;
    SceneLights& operator=(const SceneLights&) = delete;

    const Forest& forest() const { return forest_; }

    /// Calls `f(forest)` with the same trees but that of virtual lights if the scene has none: that some lights may be
    /// clamped is what a lightcut pays for even where there are no such lights.
    template <class F>
    decltype(auto) visit(F&& f) const {
        return virtual_.empty() ? f(direct_) : f(forest_);
    }

private:
    lightcuts::LightTree<lightcuts::OmniLight<>> omni_;
    lightcuts::LightTree<lightcuts::OrientedPointLight<>> oriented_;
    lightcuts::LightTree<lightcuts::SpotLight<>> spots_;
    lightcuts::LightTree<lightcuts::DistantLight<>> directional_;
    lightcuts::LightTree<lightcuts::SpherePointLight<>> spheres_;
    lightcuts::LightTree<lightcuts::VirtualPointLight<>> virtual_;
    DirectForest direct_{omni_, oriented_, spots_, directional_, spheres_};
    Forest forest_{omni_, oriented_, spots_, directional_, spheres_, virtual_};
};

}  // namespace render
