#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <render/rays/ray_scene.hpp>
#include <render/rays/sky_rays.hpp>

#include "directions.hpp"
#include "site.hpp"

namespace relight {

/// From which sides the sites of a mesh look at the sky: the front alone will do where all that is seen of a mesh is
/// the side from which its triangles' corners run counter-clockwise.
enum class Sides : std::uint8_t { front, both };

/// The sky as sites see it, one after another. threads: one object a thread.
class SiteSky {
public:
    /// Both references are kept.
    SiteSky(const Directions& directions, const render::RayScene& rays, Sides sides);

    /// Traces a ray for each direction that a surface at `site` could reflect. Above the horizon they start on the
    /// front, below on the back, if that is asked for.
    void look(const Site& site);

    /// By direction, the share that is visible; of those that `look` did not ask for, the mean of those of the lowest
    /// cluster that has any, so that a horizon takes no pieces of a cut.
    std::span<const float> shares() const { return shares_; }
    /// By direction, whether it was asked for.
    bool was_asked(std::size_t direction) const { return asked_[direction] != 0; }
    std::size_t asked_count() const { return count_; }
    /// Seconds that all rays of this object took.
    double ray_seconds() const { return ray_seconds_; }

private:
    void trace(const glm::vec3& from, std::size_t begin, std::size_t end);
    void fill();

    const Directions& directions_;
    const render::RayScene& rays_;
    render::SkyRays sky_;
    Sides sides_;
    std::size_t count_ = 0;
    double ray_seconds_ = 0.0;
    std::vector<float> shares_;
    std::vector<std::uint8_t> asked_;
    std::vector<std::uint32_t> order_;  ///< directions that are traced
    std::vector<glm::vec3> traced_;
    std::vector<float> answers_;
    std::vector<float> sums_, counts_;  ///< by node, of what was asked for
};

}  // namespace relight
