#include "lights/emission_samples.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <lightcuts/core/random.hpp>
#include <lightcuts/core/spectrum.hpp>

#include "surfaces/surface_colors.hpp"
#include "triangle.hpp"

namespace render {
namespace {

using glm::dvec2;
using glm::dvec3;

/// Least number of pieces to begin with where the radiance varies, so that points lie where the light is; fewer where
/// so few lights are wanted that there must be very many emitters.
constexpr double least_varying_pieces = 4096.0;
constexpr double varying_pieces_per_point = 256.0;
/// To tell the power only.
constexpr double least_power_pieces = 16.0;

/// The mean radiance of a piece is that of so many points, one in each of its sixteenths.
constexpr int points_per_piece = 16;
/// Largest standard deviation of a surface's power, as a share.
constexpr double usual_tolerance = 0.0025;
constexpr double rough_tolerance = 0.05;
/// Of more surfaces than these, each may be off by more, so that all together are as good, and load as fast.
constexpr double many_surfaces = 1000.0;
constexpr std::size_t most_parts = std::size_t{1} << 19;
constexpr std::size_t least_most_parts = 4096;

/// A channel with less than this share of the brightest one's power is measured by that.
constexpr double faint_channel = 1e-4;

double sum_of(const dvec3& v) { return v.x + v.y + v.z; }

double largest_of(const dvec3& v) { return std::max({v.x, v.y, v.z}); }

/// Corners of smaller pieces would not be exact in float.
bool can_be_halved(const Piece& piece) {
    constexpr float smallest = 0x1p-21f;
    const auto [a, b, c] = piece.corners;
    const glm::vec2 extent = glm::max(a, glm::max(b, c)) - glm::min(a, glm::min(b, c));
    return std::max(extent.x, extent.y) > smallest;
}

/// Mean of what a piece emits on its front, from a point in each of its sixteenths, drawn by a hash: points of a grid
/// would all fall on bars of a grating, or between them.
dvec3 mean_radiance(const Scene& scene, const Piece& piece, std::uint64_t index) {
    const auto& [a, b, c] = piece.corners;
    const glm::vec2 along = 0.25f * (b - a);
    const glm::vec2 across = 0.25f * (c - a);
    dvec3 sum(0.0);
    std::uint64_t drawn = 0;
    const auto add = [&](const glm::vec2& corner, float side) {
        const std::uint64_t bits = lightcuts::hash_keys(piece.triangle, index, drawn++);
        auto s = static_cast<float>(lightcuts::uniform01(bits));
        auto t = static_cast<float>(lightcuts::uniform01(lightcuts::mix_bits(bits)));
        if (s + t > 1.0f) {
            s = 1.0f - s;
            t = 1.0f - t;
        }
        const glm::vec2 at = corner + side * (s * along + t * across);
        sum += dvec3(emitted_radiance(scene, piece.triangle, at.x, at.y, true));
    };
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4 - i; ++j) {
            const glm::vec2 corner = a + static_cast<float>(i) * along + static_cast<float>(j) * across;
            add(corner, 1.0f);
            if (i + j < 3) add(corner + along + across, -1.0f);  // the one that stands on its head
        }
    }
    return sum / static_cast<double>(points_per_piece);
}

/// The largest standard deviation of what lies within a range and has that mean [Bhatia and Davis 2000]. As the mean of
/// a few points may miss what is bright or dark, it counts as not too near to the ends.
double deviation(double low, double high, double mean) {
    const double least = (high - low) / 64.0;
    return std::sqrt(std::max(mean - low, least) * std::max(high - mean, least));
}

}  // namespace

EmissionSampler::EmissionSampler(const Scene& scene, std::span<const std::uint32_t> materials, std::size_t surfaces)
    : scene_(scene), range_(scene, materials),
      tolerance_(usual_tolerance * std::sqrt(std::max(static_cast<double>(surfaces) / many_surfaces, 1.0))),
      most_parts_(std::max(most_parts / std::max<std::size_t>(surfaces, 1), least_most_parts)) {}

bool EmissionSampler::is_varying(std::span<const std::uint32_t> triangles) const {
    return std::any_of(triangles.begin(), triangles.end(), [&](std::uint32_t t) {
        return has_varying_emission(scene_, scene_.materials[scene_.triangle_material[t]]);
    });
}

/// False if the part emits nothing.
bool EmissionSampler::measure(Part& part, std::uint64_t index) const {
    const EmissionRange::Bounds bounds = range_.over(part);
    if (!(largest_of(bounds.high) > 0.0)) return false;
    part.range = part.area * (bounds.high - bounds.low);
    part.deviation = dvec3(0.0);
    if (bounds.high == bounds.low) {
        part.power = part.area * bounds.low;
        return true;
    }
    const dvec3 mean = mean_radiance(scene_, part, index);
    part.power = part.area * mean;
    for (int c = 0; c < 3; ++c) part.deviation[c] = part.area * deviation(bounds.low[c], bounds.high[c], mean[c]);
    return true;
}

EmissionSampler::Parts EmissionSampler::parts_of(std::span<const std::uint32_t> triangles, double least,
                                                 double tolerance) const {
    // The deviation of the sum is that of its pieces, which are independent: that of a point by the root of the points.
    const double most_doubt = std::sqrt(static_cast<double>(points_per_piece)) * tolerance;
    std::vector<Part> parts;
    std::uint64_t index = 0;
    for (const Piece& piece : cut_into_pieces(scene_, triangles, 1.0 / least)) {
        Part part{piece, {}, {}, {}};
        if (measure(part, index++)) parts.push_back(part);
    }
    const std::uint64_t most = index + most_parts_;
    struct Doubt {
        double range = 0;
        double variance = 0;
        std::size_t part = 0;
    };
    std::vector<Doubt> doubts;
    for (;;) {
        dvec3 power(0.0);
        for (const Part& part : parts) power += part.power;
        const dvec3 whole = glm::max(power, dvec3(std::max(faint_channel * largest_of(power), 1e-300)));
        doubts.clear();
        double sum = 0;
        double fixed = 0;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const double range = largest_of(parts[i].range / whole);
            if (!(range > 0.0)) continue;
            const double deviation = std::min(largest_of(parts[i].deviation / whole), 1e100);
            const double variance = deviation * deviation;
            (can_be_halved(parts[i]) ? sum : fixed) += variance;
            if (can_be_halved(parts[i])) doubts.push_back({range, variance, i});
        }
        const double allowed = most_doubt * most_doubt;
        if (sum <= allowed || doubts.empty() || index >= most) {
            return {std::move(parts), power, std::sqrt(sum + fixed) / most_doubt * tolerance};
        }
        // The pieces of the largest ranges, until what is left would be little. Not those of the largest deviations,
        // which are of pieces whose points happened to be bright: to look twice at these alone would lose light.
        std::sort(doubts.begin(), doubts.end(), [](const Doubt& a, const Doubt& b) {
            return a.range > b.range || (a.range == b.range && a.part < b.part);
        });
        std::size_t count = 0;
        for (double left = sum; count < doubts.size() && left > 0.25 * allowed && index + 2 * count < most; ++count) {
            left -= doubts[count].variance;
        }
        bool some_are_dark = false;
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t i = doubts[k].part;
            const auto both = halves(parts[i], range_.longest_edge(parts[i]));
            bool is_replaced = false;
            for (const Piece& half : both) {
                Part part{half, {}, {}, {}};
                if (!measure(part, index++)) continue;
                if (is_replaced) {
                    parts.push_back(part);
                } else {
                    parts[i] = part;
                }
                is_replaced = true;
            }
            if (!is_replaced) {
                parts[i].power = parts[i].range = dvec3(0.0);
                some_are_dark = true;
            }
        }
        if (some_are_dark) {
            std::erase_if(parts, [](const Part& part) { return part.power == dvec3(0.0) && part.range == dvec3(0.0); });
        }
    }
}

/// True iff the surface shows but one color of its maps.
bool EmissionSampler::is_even(std::span<const std::uint32_t> triangles, const Parts& known) const {
    constexpr double rounding = 1e-6;
    if (known.all.empty()) return false;
    const dvec3 mean = known.power / area_of(scene_, triangles);
    // What is dark is in no part, so that the mean of all is less than that of each.
    return std::all_of(known.all.begin(), known.all.end(), [&](const Part& part) {
        return part.range == dvec3(0.0) &&
               largest_of(glm::abs(part.power / part.area - mean)) <= rounding * largest_of(mean);
    });
}

/// Not in the holes of a mask, nor where the map is black.
dvec2 EmissionSampler::lit_place(const Part& part, double along, double across, std::uint64_t index) const {
    constexpr std::uint64_t most_tries = 32;
    dvec2 place = part.at(along, across);
    for (std::uint64_t tries = 1; tries < most_tries; ++tries) {
        const auto u = static_cast<float>(place.x);
        const auto v = static_cast<float>(place.y);
        if (emitted_radiance(scene_, part.triangle, u, v, true) != glm::vec3(0.0f)) break;
        const std::uint64_t bits = lightcuts::hash_keys(part.triangle, index, tries);
        place = part.at(lightcuts::uniform01(bits), lightcuts::uniform01(lightcuts::mix_bits(bits)));
    }
    return place;
}

std::vector<EmissionSample> EmissionSampler::spread(std::span<const std::uint32_t> triangles, std::size_t count) const {
    std::vector<EmissionSample> samples;
    const double points = static_cast<double>(count);
    const auto spread_evenly = [&] {
        const double area = area_of(scene_, triangles);
        for (const AreaSample& place : spread_by_area(scene_, triangles, count)) {
            const dvec3 radiance(emitted_radiance(scene_, place.triangle, 1.0f / 3.0f, 1.0f / 3.0f, true));
            if (radiance == dvec3(0.0)) continue;
            samples.push_back({place, glm::vec3(radiance * (area / points))});
        }
        return samples;
    };
    if (!is_varying(triangles)) return spread_evenly();
    const double pieces = std::max(pieces_per_point * points,
                                   std::min(varying_pieces_per_point * points, least_varying_pieces));
    Parts known = parts_of(triangles, pieces, tolerance_);
    if (is_even(triangles, known)) return spread_evenly();
    largest_error_ = std::max(largest_error_, known.error);
    std::erase_if(known.all, [](const Part& part) { return !(sum_of(part.power) > 0.0); });
    if (known.all.empty() || count == 0) return samples;
    const std::vector<Part> parts = SpaceCurve(scene_, triangles).sorted(known.all);

    // One point in the middle of each of `count` equal parts of the power along the curve.
    double total = 0;
    for (const Part& part : parts) total += sum_of(part.power);
    std::size_t at = 0;
    double before = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double begin = total * static_cast<double>(i) / points;
        const double middle = total * (static_cast<double>(i) + 0.5) / points;
        const double end = total * (static_cast<double>(i) + 1.0) / points;
        dvec3 power(0.0);
        std::size_t chosen = at;
        double along = 0;
        for (;; ++at) {
            const double here = sum_of(parts[at].power);
            const double common = std::min(end, before + here) - std::max(begin, before);
            if (common > 0.0) power += parts[at].power * (common / here);
            if (before <= middle) {
                chosen = at;
                along = std::clamp((middle - before) / here, 0.0, 1.0);
            }
            if (at + 1 == parts.size() || before + here >= end) break;
            before += here;
        }
        const dvec2 place = lit_place(parts[chosen], along, golden_fraction(i), i);
        samples.push_back({sample_at(scene_, parts[chosen].triangle, place), glm::vec3(power)});
    }
    return samples;
}

double EmissionSampler::power(std::span<const std::uint32_t> triangles) const {
    if (triangles.empty()) return 0.0;
    if (is_varying(triangles)) return sum_of(parts_of(triangles, least_power_pieces, rough_tolerance).power);
    double power = 0;
    for (const std::uint32_t t : triangles) {
        power += Triangle(scene_, t).area() *
                 lightcuts::channel_sum(emitted_radiance(scene_, t, 1.0f / 3.0f, 1.0f / 3.0f, true));
    }
    return power;
}

}  // namespace render
