#include "illumination.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <oneapi/tbb/parallel_for.h>
#include <lightcuts/core/invalid_input.hpp>
#include <lightcuts/source/environment.hpp>

namespace relight {

namespace {

/// Pixels of the split map for each direction, at least: fewer would leave some directions dark.
constexpr std::size_t pixels_per_direction = 32;

}  // namespace

SplitMap::SplitMap(const render::Picture& map, float scale, std::size_t directions, const std::string& name) {
    const auto columns = static_cast<std::uint32_t>(map.width), rows = static_cast<std::uint32_t>(map.height);
    const lightcuts::EnvironmentMap<lightcuts::RowMajorPixels<glm::vec3>> whole(columns, rows,
                                                                                {map.pixels.data(), columns}, scale);
    try {
        lightcuts::environment_lights(whole, 0);  // checks it
    } catch (const lightcuts::invalid_input& problem) {
        throw lightcuts::invalid_input(name + ": " + problem.what() + "; correct it or give another map");
    }
    // Rows are halved or multiplied together with columns, so that pixels stay what they are in longitude.
    const std::size_t wanted = pixels_per_direction * directions;
    std::uint32_t together = 1, parts = 1;
    const auto size = [&] { return std::size_t{columns} * rows * parts * parts / (std::size_t{together} * together); };
    while (rows % (2 * together) == 0 && size() / 4 >= wanted) together *= 2;
    while (together == 1 && size() < wanted) ++parts;
    width_ = static_cast<int>(columns / together * parts);
    height_ = static_cast<int>(rows / together * parts);
    power_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), glm::vec3(0.0f));
    tbb::parallel_for(0, height_, [&](int row) {
        const auto edge = [&](std::uint32_t r, std::uint32_t of) { return std::cos(std::numbers::pi * r / of); };
        const auto r = static_cast<std::uint32_t>(row);
        for (int column = 0; column < width_; ++column) {
            const auto c = static_cast<std::uint32_t>(column);
            glm::dvec3 sum(0.0);
            for (std::uint32_t y = r * together / parts; y < (r * together / parts) + together; ++y) {
                // A part of a row has its own share of the row's solid angle.
                const double band = parts > 1 ? edge(r, rows * parts) - edge(r + 1, rows * parts)
                                              : edge(y, rows) - edge(y + 1, rows);
                const double angle = 2.0 * std::numbers::pi / (columns * parts) * band;
                for (std::uint32_t x = c * together / parts; x < (c * together / parts) + together; ++x) {
                    sum += glm::dvec3(map.pixels[std::size_t{y} * columns + x]) * (angle * static_cast<double>(scale));
                }
            }
            power_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(column)] = glm::vec3(sum);
        }
    });
}

void SplitMap::turn(double degrees, const NearestDirection& nearest, std::vector<glm::vec3>& power) const {
    std::vector<std::uint32_t> items(power_.size());
    const double turned = degrees * std::numbers::pi / 180.0;
    std::vector<glm::dvec2> around(static_cast<std::size_t>(width_));
    for (int column = 0; column < width_; ++column) {
        const double longitude = std::numbers::pi * (1.0 - 2.0 * (column + 0.5) / width_) + turned;
        around[static_cast<std::size_t>(column)] = {std::sin(longitude), std::cos(longitude)};
    }
    tbb::parallel_for(0, height_, [&](int row) {
        const double latitude = std::numbers::pi * (0.5 - (row + 0.5) / height_);
        const double sine = std::sin(latitude), cosine = std::cos(latitude);
        for (int column = 0; column < width_; ++column) {
            const glm::dvec2 to = around[static_cast<std::size_t>(column)] * cosine;
            items[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(column)] =
                nearest({to.x, sine, to.y});
        }
    });
    // In the order of the pixels, so that sums do not depend on threads.
    std::fill(power.begin(), power.end(), glm::vec3(0.0f));
    for (std::size_t i = 0; i < items.size(); ++i) power[items[i]] += power_[i];
}

void Illumination::set(std::span<const glm::vec3> power, const IlluminationOptions& options) {
    const lightcuts::ClusterTree& tree = directions_.tree;
    lightcuts::refit_moments(tree, moments_, [&](std::uint32_t item) { return power[item]; });
    approximation_.start(tree, moments_);
    const double most_radius = options.cluster_angle * std::numbers::pi / 180.0;
    approximation_.refine([&](std::uint32_t n) { return static_cast<double>(directions_.clusters[n].radius); },
                          most_radius, options.size);
    const lightcuts::Moments<3>& all = moments_[tree.root()];
    const double total = (all.mean[0] + all.mean[1] + all.mean[2]) * all.leaves;
    approximation_.refine_by_error(options.relative_error * total, options.size);
    approximation_.refine_by_value(options.size);
    approximation_.store(cut_);
    lights_.resize(tree.size());
    for (std::uint32_t n = 0; n < tree.size(); ++n) {
        const lightcuts::Moments<3>& m = moments_[n];
        lights_[n] = {directions_.clusters[n].direction, directions_.clusters[n].radius,
                      glm::vec3(m.mean[0] * m.leaves, m.mean[1] * m.leaves, m.mean[2] * m.leaves), 0.0f};
    }
}

}  // namespace relight
