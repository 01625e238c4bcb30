#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <lightcuts/visibility/query.hpp>

#include "rays/ray_scene.hpp"

namespace render {

/// The visibility of many directions or places from one point, by streams of Embree rays. Where surfaces let light pass
/// it is the share that passes, the mean of its channels. Keeps storage: one object a thread.
class SkyRays {
public:
    /// shares[i], in [0, 1], of what arrives at `from` from directions[i]. pre: nothing moves; equal sizes; unit
    /// directions. cost: a ray a direction; neighboring directions one after another take less time.
    void look(const RayScene& rays, const glm::vec3& from, std::span<const glm::vec3> directions,
              std::span<float> shares);

    /// The same of what arrives from `places`, which lie off all surfaces. cost: a ray a place.
    void look_at(const RayScene& rays, const glm::vec3& from, std::span<const glm::vec3> places,
                 std::span<float> shares);

private:
    void ask(const RayScene& rays, const glm::vec3& from, std::span<const glm::vec3> to, bool distant,
             std::span<float> shares);

    std::vector<lightcuts::VisibilityQuery> queries_;
};

}  // namespace render
