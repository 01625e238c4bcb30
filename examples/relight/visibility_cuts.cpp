#include "visibility_cuts.hpp"

#include <algorithm>
#include <cmath>

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <lightcuts/piecewise/approximate.hpp>
#include <lightcuts/piecewise/cut_file.hpp>
#include <lightcuts/piecewise/moments.hpp>
#include <render/progress.hpp>
#include <render/stopwatch.hpp>

namespace relight {

namespace {

/// What a thread keeps between sites.
struct Scratch {
    SiteSky sky;
    std::vector<lightcuts::Moments<1>> moments;
    lightcuts::PiecewiseConstant<float> cut;
    double seconds = 0.0;
};

struct SiteCut {
    std::vector<std::byte> bytes;
    std::size_t pieces = 0;
    std::size_t rays = 0;
    double squared_error = 0.0;
};

SiteCut cut_at(const Site& site, const Directions& directions, const CutOptions& options, Scratch& scratch) {
    scratch.sky.look(site);
    const std::span<const float> shares = scratch.sky.shares();
    lightcuts::refit_moments(directions.tree, scratch.moments, [&](std::uint32_t item) { return shares[item]; });
    lightcuts::approximate(directions.tree, scratch.moments, options.deviation, scratch.cut);
    SiteCut result;
    const lightcuts::CutEncoding encoding{options.bits, false};
    lightcuts::encode(scratch.cut, encoding, result.bytes);
    // What is stored is what will be seen.
    lightcuts::decode(result.bytes, encoding, directions.tree, scratch.cut, 0);
    result.pieces = scratch.cut.size();
    result.rays = scratch.sky.asked_count();
    std::size_t item = 0;
    for (std::size_t i = 0; i < scratch.cut.size(); ++i) {
        const float value = scratch.cut.values()[i];
        for (const std::size_t end = scratch.cut.pieces()[i].leaf_end(); item < end; ++item) {
            const double off = scratch.sky.was_asked(item) ? static_cast<double>(shares[item] - value) : 0.0;
            result.squared_error += off * off;
        }
    }
    return result;
}

}  // namespace

double CutStatistics::mean_size() const {
    return sites > 0 ? static_cast<double>(pieces) / static_cast<double>(sites) : 0.0;
}

double CutStatistics::rms() const { return rays > 0 ? std::sqrt(squared_error / static_cast<double>(rays)) : 0.0; }

std::vector<std::byte> visibility_cuts(const Directions& directions, std::span<const Site> sites,
                                       const render::RayScene& rays, const CutOptions& options,
                                       CutStatistics& statistics, bool shown) {
    std::vector<SiteCut> cuts(sites.size());
    tbb::enumerable_thread_specific<Scratch> scratches([&] {
        return Scratch{SiteSky(directions, rays, options.sides), {}, {}};
    });
    {
        render::Progress progress(sites.size(), shown);
        tbb::parallel_for(std::size_t{0}, sites.size(), [&](std::size_t i) {
            Scratch& scratch = scratches.local();
            const render::Stopwatch watch;
            cuts[i] = cut_at(sites[i], directions, options, scratch);
            scratch.seconds += watch.seconds();
            progress.step();
        });
    }
    statistics = {};
    statistics.sites = sites.size();
    lightcuts::CutFileWriter writer(directions.tree, {options.bits, false});
    for (SiteCut& cut : cuts) {
        writer.append_encoded(cut.bytes);
        statistics.pieces += cut.pieces;
        statistics.largest = std::max(statistics.largest, cut.pieces);
        statistics.rays += cut.rays;
        statistics.squared_error += cut.squared_error;
        cut.bytes = {};
    }
    for (const Scratch& scratch : scratches) {
        statistics.seconds += scratch.seconds;
        statistics.ray_seconds += scratch.sky.ray_seconds();
    }
    return writer.bytes();
}

}  // namespace relight
