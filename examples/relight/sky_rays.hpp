#pragma once

#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <lightcuts/visibility/query.hpp>
#include <render/rays/ray_scene.hpp>

namespace relight {

/// The visibility of many directions from one point, by streams of Embree rays. Where surfaces let light pass it is the
/// share that passes, the mean of its channels. threads: one object a thread; any number on one scene.
class SkyRays {
public:
    /// `rays` must outlive this object. pre: nothing moves.
    explicit SkyRays(const render::RayScene& rays) : rays_(rays) {}

    /// shares[i], in [0, 1], of what arrives at `from` from directions[i]. pre: equal sizes; unit directions.
    /// cost: a ray a direction; neighboring directions one after another take less time.
    void look(const glm::vec3& from, std::span<const glm::vec3> directions, std::span<float> shares);

private:
    const render::RayScene& rays_;
    std::vector<lightcuts::VisibilityQuery> queries_;
};

}  // namespace relight
