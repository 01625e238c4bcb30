#pragma once

#include <cstdint>

#include <lightcuts/cut/forest.hpp>
#include <lightcuts/product/timed_forest.hpp>
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
    using ClearForest = ForestWith<lightcuts::VirtualPointLight<>>;
    using Forest = ForestWith<lightcuts::VirtualPointLight<>, lightcuts::VirtualVolumeLight<>>;
    static constexpr std::uint32_t oriented_kind = 1;
    static constexpr std::uint32_t sphere_kind = 4;
    static constexpr std::uint32_t virtual_kind = 5;

    /// `scene` must outlive this object. throws: lightcuts::invalid_input for a light that cannot be used.
    SceneLights(const Scene& scene, const Options& options);
    SceneLights(const SceneLights&) = delete;
    SceneLights& operator=(const SceneLights&) = delete;

    const Forest& forest() const { return forest_; }
    /// The same trees but those of virtual lights.
    const DirectForest& direct() const { return direct_; }

    /// Calls `f(forest)` with the same trees but those of virtual lights that the scene does not have: that some lights
    /// may be clamped is what a lightcut pays for even where there are no such lights.
    template <class F>
    decltype(auto) visit(F&& f) const {
        return !volume_.empty() ? f(forest_) : !virtual_.empty() ? f(clear_) : f(direct_);
    }

protected:
    lightcuts::LightTree<lightcuts::OmniLight<>> omni_;
    lightcuts::LightTree<lightcuts::OrientedPointLight<>> oriented_;
    lightcuts::LightTree<lightcuts::SpotLight<>> spots_;
    lightcuts::LightTree<lightcuts::DistantLight<>> directional_;
    lightcuts::LightTree<lightcuts::SpherePointLight<>> spheres_;
    lightcuts::LightTree<lightcuts::VirtualPointLight<>> virtual_;
    lightcuts::LightTree<lightcuts::VirtualVolumeLight<>> volume_;

private:
    DirectForest direct_{omni_, oriented_, spots_, directional_, spheres_};
    ClearForest clear_{omni_, oriented_, spots_, directional_, spheres_, virtual_};
    Forest forest_{omni_, oriented_, spots_, directional_, spheres_, virtual_, volume_};
};

/// The light trees of a scene in which lights move: those of `SceneLights`, and one for each kind of light that exists
/// at one instant.
class InstantSceneLights : private SceneLights {
public:
    template <class L>
    using At = lightcuts::InstantLight<L>;
    using Forest = lightcuts::TimedForest<
        lightcuts::OmniLight<>, lightcuts::OrientedPointLight<>, lightcuts::SpotLight<>, lightcuts::DistantLight<>,
        lightcuts::SpherePointLight<>, lightcuts::VirtualPointLight<>, lightcuts::VirtualVolumeLight<>,
        At<lightcuts::OmniLight<>>, At<lightcuts::OrientedPointLight<>>, At<lightcuts::SpotLight<>>,
        At<lightcuts::DistantLight<>>, At<lightcuts::SpherePointLight<>>, At<lightcuts::VirtualPointLight<>>,
        At<lightcuts::VirtualVolumeLight<>>>;
    static constexpr std::uint32_t oriented_kind = 8;
    static constexpr std::uint32_t sphere_kind = 11;
    static constexpr std::uint32_t virtual_kind = 12;

    /// `scene` must outlive this object. throws: lightcuts::invalid_input for a light that cannot be used.
    InstantSceneLights(const Scene& scene, const Options& options);

    const Forest& forest() const { return forest_; }

private:
    lightcuts::LightTree<At<lightcuts::OmniLight<>>> omni_at_;
    lightcuts::LightTree<At<lightcuts::OrientedPointLight<>>> oriented_at_;
    lightcuts::LightTree<At<lightcuts::SpotLight<>>> spots_at_;
    lightcuts::LightTree<At<lightcuts::DistantLight<>>> directional_at_;
    lightcuts::LightTree<At<lightcuts::SpherePointLight<>>> spheres_at_;
    lightcuts::LightTree<At<lightcuts::VirtualPointLight<>>> virtual_at_;
    lightcuts::LightTree<At<lightcuts::VirtualVolumeLight<>>> volume_at_;
    Forest forest_;
};

}  // namespace render
