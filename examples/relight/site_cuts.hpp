#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <lightcuts/piecewise/approximate.hpp>
#include <lightcuts/piecewise/cut_file.hpp>
#include <lightcuts/piecewise/moments.hpp>
#include <render/progress.hpp>
#include <render/stopwatch.hpp>

#include "cut_statistics.hpp"
#include "site.hpp"

namespace relight {

/// How a function of sites is kept as cuts.
struct SiteCutOptions {
    double deviation = 0.0;  ///< largest L2 error of a node [Cut merging 2008, Eq. 5]
    lightcuts::ValueBits bits = lightcuts::ValueBits::eight;
    float (*stored)(float) = nullptr;  ///< what is stored of a value, and its inverse; none: the value itself
    float (*read)(float) = nullptr;
};

/// The bytes of a file of one cut a site, in their order, of what it sees of the leaves of `tree`. `make_view()`: what
/// looks, one a thread; see SiteSky and SitePatches. All threads of the calling arena work; the bytes do not depend on
/// how many there are. `shown`: progress on a terminal. cost: that of a look a site.
template <class MakeView>
std::vector<std::byte> site_cuts(const lightcuts::ClusterTree& tree, std::span<const Site> sites,
                                 const MakeView& make_view, const SiteCutOptions& options, CutStatistics& statistics,
                                 bool shown) {
    using View = decltype(make_view());
    struct Scratch {
        View view;
        std::vector<lightcuts::Moments<1>> moments;
        lightcuts::PiecewiseConstant<float> cut;
        double seconds = 0.0;
    };
    struct SiteCut {
        std::vector<std::byte> bytes;
        std::size_t pieces = 0;
        std::size_t rays = 0;
        double squared_error = 0.0;
        double squares = 0.0;
    };
    const lightcuts::CutEncoding encoding{options.bits, false};
    const auto convert = [](lightcuts::PiecewiseConstant<float>& cut, float (*to)(float)) {
        if (to == nullptr) return;
        for (float& value : cut.values()) value = to(value);
    };
    const auto cut_at = [&](const Site& site, Scratch& scratch) {
        scratch.view.look(site);
        const std::span<const float> shares = scratch.view.shares();
        lightcuts::refit_moments(tree, scratch.moments, [&](std::uint32_t item) { return shares[item]; });
        lightcuts::approximate(tree, scratch.moments, options.deviation, scratch.cut);
        SiteCut result;
        convert(scratch.cut, options.stored);
        lightcuts::encode(scratch.cut, encoding, result.bytes);
        // What is stored is what will be seen.
        lightcuts::decode(result.bytes, encoding, tree, scratch.cut, 0);
        convert(scratch.cut, options.read);
        result.pieces = scratch.cut.size();
        result.rays = scratch.view.asked_count();
        std::size_t item = 0;
        for (std::size_t i = 0; i < scratch.cut.size(); ++i) {
            const float value = scratch.cut.values()[i];
            for (const std::size_t end = scratch.cut.pieces()[i].leaf_end(); item < end; ++item) {
                if (!scratch.view.was_asked(item)) continue;
                const double share = static_cast<double>(shares[item]), off = static_cast<double>(shares[item] - value);
                result.squared_error += off * off;
                result.squares += share * share;
            }
        }
        return result;
    };
    std::vector<SiteCut> cuts(sites.size());
    tbb::enumerable_thread_specific<Scratch> scratches([&] { return Scratch{make_view(), {}, {}}; });
    {
        render::Progress progress(sites.size(), shown);
        tbb::parallel_for(std::size_t{0}, sites.size(), [&](std::size_t i) {
            Scratch& scratch = scratches.local();
            const render::Stopwatch watch;
            cuts[i] = cut_at(sites[i], scratch);
            scratch.seconds += watch.seconds();
            progress.step();
        });
    }
    statistics = {};
    statistics.sites = sites.size();
    lightcuts::CutFileWriter writer(tree, encoding);
    for (SiteCut& cut : cuts) {
        writer.append_encoded(cut.bytes);
        statistics.pieces += cut.pieces;
        statistics.largest = std::max(statistics.largest, cut.pieces);
        statistics.rays += cut.rays;
        statistics.squared_error += cut.squared_error;
        statistics.squares += cut.squares;
        cut.bytes = {};
    }
    for (const Scratch& scratch : scratches) {
        statistics.seconds += scratch.seconds;
        statistics.ray_seconds += scratch.view.ray_seconds();
    }
    return writer.bytes();
}

}  // namespace relight
