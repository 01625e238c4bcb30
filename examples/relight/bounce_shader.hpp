#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <lightcuts/piecewise/piecewise_constant.hpp>

#include "bounce_light.hpp"
#include "corner_cuts.hpp"
#include "relight_file.hpp"
#include "relit_shader.hpp"
#include "seen_points.hpp"
#include "site.hpp"

namespace relight {

struct BounceOptions {
    std::size_t size = 256;         ///< most pieces of the cut of reflected light
    double relative_error = 0.01;   ///< refined by error to this share of all light, then by value
    float cluster_angle = 0.2618f;  ///< radians: the BRDF is evaluated once in a cluster of this radius, or smaller
};

/// Adds light that surfaces reflect once: at each point the bounce cuts of the triangle's three corners, interpolated
/// and multiplied with the light of each node, and the products of the nodes below a piece of the light's cut with the
/// BRDF towards their mean place [Cut merging 2008, section 3.1]. Clusters that are wide as seen from the triangle are
/// divided, with what is seen of the whole shared out evenly. A triangle's cuts are merged once, for all its points.
class BounceShader {
public:
    /// Reads the bounce cuts of all corners of triangles in sight. `file`, `seen` and `sites` must outlive this object.
    /// pre: the file has a bounce. throws: invalid_input if a cut is damaged. threads: those of the calling arena.
    BounceShader(const RelightFile& file, const Sites& sites, const SeenPoints& seen);

    /// By point, adds to `radiance` what it reflects of `light`. threads: those of the calling arena; the result does
    /// not depend on how many there are. pre: the light is of the file's patches.
    void add(const BounceLight& light, const BounceOptions& options, const RelitOptions& lobes,
             std::span<glm::vec3> radiance) const;

    /// Of the cuts in use.
    double mean_cut_size() const { return cuts_.mean_size(); }

private:
    struct Scratch;
    void merge(std::span<const std::uint32_t> points, const BounceLight& light, const BounceOptions& options,
               Scratch& scratch) const;
    glm::vec3 shade(const render::SurfacePoint& point, const BounceLight& light, const RelitOptions& lobes,
                    Scratch& scratch) const;

    const Sites& sites_;
    const SeenPoints& seen_;
    Sides sides_;
    CornerCuts cuts_;
};

}  // namespace relight
