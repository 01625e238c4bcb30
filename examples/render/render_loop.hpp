#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "io/picture.hpp"
#include "moving_view.hpp"
#include "options.hpp"
#include "shader.hpp"
#include "surfaces/surface.hpp"

namespace render {

/// Counts over everything that was shaded. Independent of the number of threads.
struct RenderStatistics {
    std::uint64_t pixels = 0;  ///< finished
    std::uint64_t points = 0;  ///< surface points shaded
    std::uint64_t cuts = 0;    ///< one for each point, or for each pixel where all its points are shaded at once
    std::uint64_t shadow_rays = 0;
    std::uint64_t cut_nodes = 0;      ///< sum of the cuts' sizes
    std::uint64_t hidden = 0;         ///< of these, proved to be hidden
    std::uint64_t gather_points = 0;  ///< lobes of surface points where all points of a pixel are shaded at once
    double pairs = 0;                 ///< of these and lights, where pairs are summed up
    std::uint64_t largest_cut = 0;
    std::uint64_t at_limit = 0;  ///< cuts that ended at the largest size allowed
    double error_bound_sum = 0;  ///< over pixels, of the largest channel
    double largest_error_bound = 0;
    std::uint64_t clamp_thresholds = 0;  ///< channels of points in which there was one
    double clamp_threshold_sum = 0;
    double least_clamp_threshold = std::numeric_limits<double>::infinity();
    double largest_clamp_threshold = 0;
};

class ResumeFile;

struct Rendering {
    Picture picture;
    RenderStatistics statistics;
    bool interrupted = false;       ///< pixels that were not finished are black
    std::size_t tiles = 0;          ///< finished
    std::size_t resumed_tiles = 0;  ///< of these, by an earlier run
};

/// Renders with `options.spp` eye rays a pixel. Tiles are spread over the threads of the calling task arena; a signal
/// (`interrupted()`) ends the work at once, and the tiles at hand are left out. The picture is the same for any number
/// of threads. `resume_file`, if there is one, gives the tiles that are in it and gets the others.
/// Channels as `options.aovs` asks: `cut_size`, `shadow_rays` (sums along an eye ray, mean over the pixel's rays),
/// `hidden_share` (of the clusters on the pixel's cuts, those that were proved to be hidden),
/// `gather_points` (of the pixel), `instants` (mean number of instants of the clusters of gather points on the cut),
/// `error_bound.R` `.G` `.B` and `expected_error.R` `.G` `.B` (likewise, weighted along mirror paths), `depth` (mean
/// over the rays that hit a surface, infinite if none does), `normal.X` `.Y` `.Z` (mean of the first hits' shading
/// normals).
Rendering render_picture(const MovingView& view, const EyePathTracer& surfaces, const Shader& shader,
                         const Options& options, ResumeFile* resume_file = nullptr);

}  // namespace render
