#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include "corner_cuts.hpp"
#include "illumination.hpp"
#include "relight_file.hpp"
#include "seen_points.hpp"
#include "site.hpp"

namespace relight {

struct RelitOptions {
    /// Clusters about the mirror direction of a glossy point are split until their radius is at most so much of the
    /// lobe's width, or they are single directions.
    float gloss_detail = 0.6f;
};

/// What points took. Independent of the number of threads.
struct RelitStatistics {
    std::uint64_t triangles = 0;   ///< that are seen: a merge of cuts each
    std::uint64_t nodes = 0;       ///< of these merges, where not all corners see nothing
    std::uint64_t clusters = 0;    ///< summed over the points: where the BRDF is evaluated
    std::uint64_t directions = 0;  ///< summed over glossy points, at which their BRDF was evaluated
    std::uint64_t glossy = 0;      ///< points
    std::uint64_t backs = 0;       ///< points that are black: they show a side that was not prepared
};

/// Shades points by cuts: at each the visibility cuts of the triangle's three corners, interpolated and multiplied with
/// the light of each node, exact means of a whole tree; and the products of the nodes below a piece of the illumination
/// cut with the BRDF at their mean direction [Cut merging 2008, section 4.2]. Where a lobe varies over the piece it is
/// evaluated at the nodes, and further down. A triangle's cuts are merged once, for all its points.
class RelitShader {
public:
    /// Reads the cuts of all corners of triangles in sight. `seen` and `sites` must outlive this object.
    /// throws: invalid_input if one of them is damaged. threads: those of the calling arena.
    RelitShader(const RelightFile& file, const Sites& sites, const SeenPoints& seen);

    /// By point, the radiance that it reflects. threads: those of the calling arena; the result does not depend on how
    /// many there are. pre: the illumination is over the file's directions.
    RelitStatistics shade(const Illumination& light, const RelitOptions& options, std::span<glm::vec3> radiance) const;

    /// Of the cuts in use.
    double mean_cut_size() const { return cuts_.mean_size(); }
    std::size_t cut_count() const { return cuts_.size(); }

private:
    struct Scratch;
    /// `points`: all of one triangle.
    void merge(std::span<const std::uint32_t> points, const Illumination& light, Scratch& scratch) const;
    glm::vec3 shade(const render::SurfacePoint& point, const Illumination& light, const RelitOptions& options,
                    Scratch& scratch) const;

    const Sites& sites_;
    const SeenPoints& seen_;
    Sides sides_;
    CornerCuts cuts_;
};

}  // namespace relight
