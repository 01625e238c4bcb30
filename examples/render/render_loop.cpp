#include "render_loop.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include "interrupt.hpp"
#include "io/resume_file.hpp"
#include "pixel_filter.hpp"
#include "progress.hpp"
#include "shutter.hpp"
#include "tile_order.hpp"

namespace render {

namespace {

constexpr int tile_side = 16;
/// Points are shaded as soon as so many wait, so that many eye rays a pixel do not need much memory.
constexpr std::size_t largest_batch = 2048;

/// What a pixel has gathered from its eye rays.
struct PixelSum {
    glm::dvec3 radiance{0.0};
    glm::dvec3 error_bound{0.0};
    glm::dvec3 expected_error{0.0};
    glm::dvec3 normal{0.0};
    double depth = 0;
    int hits = 0;
    double cut_size = 0;
    double shadow_rays = 0;
    double hidden = 0;
    double gather_points = 0;
    double instants = 0;
    int shadings = 0;
};

/// A thread's memory.
struct Workspace {
    std::unique_ptr<Shader::Scratch> scratch;
    std::vector<SurfacePoint> points;
    std::vector<Shading> shadings;
    std::vector<PixelSum> sums;
};

class TileRenderer {
public:
    TileRenderer(const MovingView& view, const EyePathTracer& surfaces, const Shader& shader, const Options& options,
                 Picture& picture)
        : view_(view), surfaces_(surfaces), shader_(shader), options_(options), filter_(options.filter),
          picture_(picture) {}

    /// Fills the tile's pixels; nothing if it is interrupted.
    std::optional<RenderStatistics> render(const Tile& tile, Workspace& work) const {
        RenderStatistics statistics;
        const int columns = tile.x1 - tile.x0;
        work.sums.assign(static_cast<std::size_t>(columns * (tile.y1 - tile.y0)), PixelSum{});
        work.points.clear();
        const auto sum_of = [&](int x, int y) -> PixelSum& {
            return work.sums[static_cast<std::size_t>((y - tile.y0) * columns + x - tile.x0)];
        };
        if (shader_.shades_pixels()) {
            for (int y = tile.y0; y < tile.y1; ++y) {
                for (int x = tile.x0; x < tile.x1; ++x) {
                    for (int sample = 0; sample < options_.spp; ++sample) {
                        if (interrupted()) return std::nullopt;
                        cast(x, y, sample, sum_of(x, y), work.points);
                    }
                    shade_pixel(sum_of(x, y), work, statistics);
                }
            }
        } else {
            for (int sample = 0; sample < options_.spp; ++sample) {
                for (int y = tile.y0; y < tile.y1; ++y) {
                    for (int x = tile.x0; x < tile.x1; ++x) {
                        if (interrupted()) return std::nullopt;
                        cast(x, y, sample, sum_of(x, y), work.points);
                        if (work.points.size() >= largest_batch) shade(tile, work, statistics);
                    }
                }
            }
            shade(tile, work, statistics);
        }
        // The last points may be those that were given up.
        if (interrupted()) return std::nullopt;
        store(tile, work.sums, statistics);
        return statistics;
    }

private:
    std::uint32_t pixel_index(int x, int y) const { return static_cast<std::uint32_t>(y * view_.width() + x); }

    EyeRay eye_ray(const View& view, int x, int y, int sample) const {
        const std::uint32_t pixel = pixel_index(x, y);
        LensSample at;
        if (view.has_lens()) {
            at = lens_sample(options_.seed, pixel, sample, options_.spp);
        } else {
            at.offset = pixel_offset(options_.seed, pixel, sample, options_.spp);
        }
        const glm::vec2 offset = filter_(at.offset);
        return view.ray(static_cast<float>(x) + offset.x, static_cast<float>(y) + offset.y, at.lens);
    }

    void cast(int x, int y, int sample, PixelSum& sum, std::vector<SurfacePoint>& points) const {
        const std::uint32_t pixel = pixel_index(x, y);
        const std::uint32_t instant = instant_of_ray(options_.seed, pixel, static_cast<std::uint32_t>(sample),
                                                     static_cast<std::uint32_t>(options_.spp), view_.instants());
        EyeRay ray = eye_ray(view_.at(instant), x, y, sample);
        ray.instant = instant;
        const EyeRaySeen seen = surfaces_.follow(ray, pixel, static_cast<std::uint32_t>(sample), points);
        sum.radiance += glm::dvec3(seen.emitted);
        if (std::isfinite(seen.depth)) {
            sum.depth += static_cast<double>(seen.depth);
            ++sum.hits;
        }
        sum.normal += glm::dvec3(seen.normal);
    }

    /// Shades all points of a pixel at once.
    void shade_pixel(PixelSum& sum, Workspace& work, RenderStatistics& statistics) const {
        const double rays = options_.spp;
        const Shading shading = shader_.shade_pixel(work.points, static_cast<float>(1.0 / rays), *work.scratch);
        sum.radiance += rays * glm::dvec3(shading.radiance);
        sum.error_bound += rays * glm::dvec3(shading.error_bound);
        sum.cut_size += rays * static_cast<double>(shading.cut_size);
        sum.shadow_rays += rays * static_cast<double>(shading.shadow_rays);
        add_points(sum, shading);
        count(shading, statistics);
        statistics.points += work.points.size();
        work.points.clear();
    }

    /// Shades the waiting points and adds them to their pixels, in the order in which the eye rays found them.
    void shade(const Tile& tile, Workspace& work, RenderStatistics& statistics) const {
        work.shadings.assign(work.points.size(), Shading{});
        shader_.shade(work.points, work.shadings, *work.scratch);
        for (std::size_t i = 0; i < work.points.size(); ++i) {
            const SurfacePoint& point = work.points[i];
            const Shading& shading = work.shadings[i];
            const int x = static_cast<int>(point.pixel) % view_.width();
            const int y = static_cast<int>(point.pixel) / view_.width();
            PixelSum& sum = work.sums[static_cast<std::size_t>((y - tile.y0) * (tile.x1 - tile.x0) + x - tile.x0)];
            for (int c = 0; c < 3; ++c) {
                const double weight = static_cast<double>(point.weight[c]);
                // A weight of zero takes away even an infinite bound.
                if (weight == 0.0) continue;
                sum.radiance[c] += weight * static_cast<double>(shading.radiance[c]);
                sum.error_bound[c] += weight * static_cast<double>(shading.error_bound[c]);
                sum.expected_error[c] += weight * static_cast<double>(shading.expected_error[c]);
            }
            sum.cut_size += static_cast<double>(shading.cut_size);
            sum.shadow_rays += static_cast<double>(shading.shadow_rays);
            sum.hidden += static_cast<double>(shading.hidden);
            add_points(sum, shading);
            count(shading, statistics);
        }
        statistics.points += work.points.size();
        work.points.clear();
    }

    static void add_points(PixelSum& sum, const Shading& shading) {
        sum.gather_points += static_cast<double>(shading.gather_points);
        sum.instants += static_cast<double>(shading.instants);
        ++sum.shadings;
    }

    static void count(const Shading& shading, RenderStatistics& statistics) {
        ++statistics.cuts;
        statistics.shadow_rays += shading.shadow_rays;
        statistics.cut_nodes += shading.cut_size;
        statistics.hidden += shading.hidden;
        statistics.gather_points += shading.gather_points;
        statistics.pairs += shading.pairs;
        statistics.largest_cut = std::max<std::uint64_t>(statistics.largest_cut, shading.cut_size);
        statistics.at_limit += shading.at_limit ? 1 : 0;
        for (int c = 0; c < 3; ++c) {
            const double threshold = static_cast<double>(shading.clamp_threshold[c]);
            if (!std::isfinite(threshold)) continue;
            ++statistics.clamp_thresholds;
            statistics.clamp_threshold_sum += threshold;
            statistics.least_clamp_threshold = std::min(statistics.least_clamp_threshold, threshold);
            statistics.largest_clamp_threshold = std::max(statistics.largest_clamp_threshold, threshold);
        }
    }

    void set(const char* name, std::size_t pixel, double value) const {
        if (Picture::Channel* channel = picture_.find(name)) channel->values[pixel] = static_cast<float>(value);
    }

    void set_color(const std::string& name, std::size_t pixel, const glm::dvec3& value) const {
        for (int c = 0; c < 3; ++c) set((name + "." + "RGB"[c]).c_str(), pixel, value[c]);
    }

    void store(const Tile& tile, const std::vector<PixelSum>& sums, RenderStatistics& statistics) const {
        const double rays = options_.spp;
        std::size_t next = 0;
        for (int y = tile.y0; y < tile.y1; ++y) {
            for (int x = tile.x0; x < tile.x1; ++x) {
                const PixelSum& sum = sums[next++];
                const std::size_t pixel = pixel_index(x, y);
                picture_.pixels[pixel] = glm::vec3(sum.radiance / rays);
                const glm::dvec3 bound = sum.error_bound / rays;
                const double largest = std::max({bound.x, bound.y, bound.z});
                statistics.error_bound_sum += largest;
                statistics.largest_error_bound = std::max(statistics.largest_error_bound, largest);
                ++statistics.pixels;
                if (picture_.channels.empty()) continue;
                set("cut_size", pixel, sum.cut_size / rays);
                set("shadow_rays", pixel, sum.shadow_rays / rays);
                set("hidden_share", pixel, sum.cut_size > 0.0 ? sum.hidden / sum.cut_size : 0.0);
                set("gather_points", pixel, sum.gather_points);
                set("instants", pixel, sum.shadings > 0 ? sum.instants / sum.shadings : 0.0);
                set_color("error_bound", pixel, bound);
                set_color("expected_error", pixel, sum.expected_error / rays);
                set("depth", pixel, sum.hits > 0 ? sum.depth / sum.hits : std::numeric_limits<double>::infinity());
                set("normal.X", pixel, sum.normal.x / rays);
                set("normal.Y", pixel, sum.normal.y / rays);
                set("normal.Z", pixel, sum.normal.z / rays);
            }
        }
    }

    const MovingView& view_;
    const EyePathTracer& surfaces_;
    const Shader& shader_;
    const Options& options_;
    PixelFilter filter_;
    Picture& picture_;
};

void add_channels(Picture& picture, const Options& options) {
    for (const std::string& name : options.aovs) {
        const bool is_color = name == "error_bound" || name == "expected_error";
        const char* parts = is_color ? "RGB" : name == "normal" ? "XYZ" : "";
        if (*parts == '\0') picture.add_channel(name);
        for (; *parts != '\0'; ++parts) picture.add_channel(name + "." + *parts);
    }
}

void accumulate(RenderStatistics& total, const RenderStatistics& tile) {
    total.pixels += tile.pixels;
    total.points += tile.points;
    total.cuts += tile.cuts;
    total.shadow_rays += tile.shadow_rays;
    total.cut_nodes += tile.cut_nodes;
    total.hidden += tile.hidden;
    total.gather_points += tile.gather_points;
    total.pairs += tile.pairs;
    total.largest_cut = std::max(total.largest_cut, tile.largest_cut);
    total.at_limit += tile.at_limit;
    total.error_bound_sum += tile.error_bound_sum;
    total.largest_error_bound = std::max(total.largest_error_bound, tile.largest_error_bound);
    total.clamp_thresholds += tile.clamp_thresholds;
    total.clamp_threshold_sum += tile.clamp_threshold_sum;
    total.least_clamp_threshold = std::min(total.least_clamp_threshold, tile.least_clamp_threshold);
    total.largest_clamp_threshold = std::max(total.largest_clamp_threshold, tile.largest_clamp_threshold);
}

/// The pixels of a tile and its statistics, out of and into a picture.
class TileExchange {
public:
    explicit TileExchange(Picture& picture) : picture_(picture) {}

    std::size_t value_count(const Tile& tile) const {
        const int pixels = (tile.x1 - tile.x0) * (tile.y1 - tile.y0);
        return static_cast<std::size_t>(pixels) * (3 + picture_.channels.size());
    }

    std::vector<float> values(const Tile& tile) const {
        std::vector<float> result;
        result.reserve(value_count(tile));
        for_each_value(tile, [&](const float& value) { result.push_back(value); });
        return result;
    }

    /// pre: as many as `value_count`.
    void set(const Tile& tile, const std::vector<float>& values) {
        auto next = values.begin();
        for_each_value(tile, [&](float& value) { value = *next++; });
    }

private:
    template <class F>
    void for_each_value(const Tile& tile, F&& f) const {
        for (int y = tile.y0; y < tile.y1; ++y) {
            for (int x = tile.x0; x < tile.x1; ++x) {
                const auto pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) +
                                   static_cast<std::size_t>(x);
                for (int c = 0; c < 3; ++c) f(picture_.pixels[pixel][c]);
                for (Picture::Channel& channel : picture_.channels) f(channel.values[pixel]);
            }
        }
    }

    Picture& picture_;
};

}  // namespace

Rendering render_picture(const MovingView& view, const EyePathTracer& surfaces, const Shader& shader,
                         const Options& options, ResumeFile* resume_file) {
    Rendering rendering;
    rendering.picture = Picture(view.width(), view.height());
    add_channels(rendering.picture, options);
    const TileRenderer renderer(view, surfaces, shader, options, rendering.picture);

    const std::vector<Tile> tiles = tiles_of(view.width(), view.height(), tile_side);
    std::vector<std::optional<RenderStatistics>> by_tile(tiles.size());
    TileExchange exchange(rendering.picture);
    if (resume_file) {
        std::vector<std::size_t> counts;
        counts.reserve(tiles.size());
        for (const Tile& tile : tiles) counts.push_back(exchange.value_count(tile));
        resume_file->read(counts, [&](const FinishedTile& finished) {
            by_tile[finished.tile] = finished.statistics;
            exchange.set(tiles[finished.tile], finished.values);
            ++rendering.resumed_tiles;
        });
    }
    tbb::enumerable_thread_specific<Workspace> workspaces([&] {
        Workspace work;
        work.scratch = shader.make_scratch();
        return work;
    });
    {
        Progress progress(tiles.size() - rendering.resumed_tiles, !options.quiet);
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size(), 1), [&](const auto& range) {
            for (std::size_t t = range.begin(); t < range.end() && !interrupted(); ++t) {
                if (by_tile[t]) continue;
                by_tile[t] = renderer.render(tiles[t], workspaces.local());
                if (!by_tile[t]) return;
                if (resume_file) {
                    resume_file->append({static_cast<std::uint32_t>(t), *by_tile[t], exchange.values(tiles[t])});
                }
                progress.step();
            }
        });
    }
    // Added in the tiles' order, so that floating-point sums do not depend on which tile was finished first.
    for (const std::optional<RenderStatistics>& tile : by_tile) {
        if (!tile) continue;
        accumulate(rendering.statistics, *tile);
        ++rendering.tiles;
    }
    rendering.interrupted = rendering.tiles < tiles.size();
    return rendering;
}

}  // namespace render
