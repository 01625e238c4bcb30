#include "area_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <lightcuts/core/random.hpp>
#include <lightcuts/core/spectrum.hpp>

#include "flat_samples.hpp"
#include "surface_colors.hpp"

namespace render {
namespace {

using glm::dvec2;
using glm::dvec3;

/// Part of a triangle, as barycentric coordinates (u, v) of its corners: sums of powers of 1/2, exact in float.
struct Piece {
    std::array<glm::vec2, 3> corners;
    std::uint32_t triangle = 0;
    std::uint64_t order = 0;  ///< along the curve
    double area = 0;
};

struct Face {
    dvec3 a, b, c;

    dvec3 at(const dvec2& uv) const { return a + uv.x * (b - a) + uv.y * (c - a); }
    dvec3 at(const glm::vec2& uv) const { return at(dvec2(uv)); }
};

Face face(const Scene& scene, std::uint32_t t) {
    const glm::uvec3 i = scene.triangles[t];
    return {dvec3(scene.positions[i.x]), dvec3(scene.positions[i.y]), dvec3(scene.positions[i.z])};
}

double area_of(const Face& f) { return 0.5 * glm::length(glm::cross(f.b - f.a, f.c - f.a)); }

/// Cuts `whole` at the middle of its longest edge until no piece is larger than `largest`.
void cut(const Face& f, const Piece& whole, double largest, std::vector<Piece>& out) {
    std::vector<Piece> open{whole};
    while (!open.empty()) {
        const Piece piece = open.back();
        open.pop_back();
        if (piece.area <= largest) {
            out.push_back(piece);
            continue;
        }
        std::size_t from = 0;
        double longest = -1.0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double length = glm::length(f.at(piece.corners[(i + 1) % 3]) - f.at(piece.corners[i]));
            if (length > longest) {
                longest = length;
                from = i;
            }
        }
        const glm::vec2 a = piece.corners[from];
        const glm::vec2 b = piece.corners[(from + 1) % 3];
        const glm::vec2 c = piece.corners[(from + 2) % 3];
        const glm::vec2 middle = 0.5f * (a + b);
        Piece half = piece;
        half.area = 0.5 * piece.area;
        half.corners = {a, middle, c};
        open.push_back(half);
        half.corners = {middle, b, c};
        open.push_back(half);
    }
}

/// The bits of x, each followed by two zeros. pre: x < 2^20.
std::uint64_t spread_bits(std::uint64_t x) {
    x = (x | (x << 32)) & 0x001f00000000ffffu;
    x = (x | (x << 16)) & 0x001f0000ff0000ffu;
    x = (x | (x << 8)) & 0x100f00f00f00f00fu;
    x = (x | (x << 4)) & 0x10c30c30c30c30c3u;
    return (x | (x << 2)) & 0x1249249249249249u;
}

/// Place along the curve: one of six directions of facing, then Morton order in the box from `low` of size `extent`.
std::uint64_t curve_order(const dvec3& p, const dvec3& normal, const dvec3& low, double extent) {
    const dvec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto facing = static_cast<std::uint64_t>(2 * axis + (normal[axis] < 0.0 ? 1 : 0));
    std::uint64_t code = 0;
    for (int i = 0; i < 3; ++i) {
        const double cell = std::clamp((p[i] - low[i]) / extent * 1048576.0, 0.0, 1048575.0);
        code |= spread_bits(static_cast<std::uint64_t>(cell)) << i;
    }
    return facing << 60 | code;
}

/// Cuts the triangles into pieces no larger than `share` of the area, sorted along the curve.
std::vector<Piece> cut_and_sort(const Scene& scene, std::span<const std::uint32_t> triangles, double share) {
    double total = 0;
    dvec3 low(std::numeric_limits<double>::max());
    dvec3 high(-low);
    for (const std::uint32_t t : triangles) {
        const Face f = face(scene, t);
        total += area_of(f);
        low = glm::min(low, glm::min(f.a, glm::min(f.b, f.c)));
        high = glm::max(high, glm::max(f.a, glm::max(f.b, f.c)));
    }
    const double extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z, 1e-300});
    std::vector<Piece> pieces;
    for (const std::uint32_t t : triangles) {
        const Face f = face(scene, t);
        Piece whole;
        whole.corners = {glm::vec2(0.0f, 0.0f), glm::vec2(1.0f, 0.0f), glm::vec2(0.0f, 1.0f)};
        whole.triangle = t;
        whole.area = area_of(f);
        if (!(whole.area > 0.0)) continue;
        const std::size_t first = pieces.size();
        cut(f, whole, share * total, pieces);
        const dvec3 normal = glm::cross(f.b - f.a, f.c - f.a);
        for (std::size_t i = first; i < pieces.size(); ++i) {
            const auto& c = pieces[i].corners;
            pieces[i].order = curve_order(f.at((dvec2(c[0]) + dvec2(c[1]) + dvec2(c[2])) / 3.0), normal, low, extent);
        }
    }
    std::stable_sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.order < b.order; });
    return pieces;
}

/// Mean of what a piece emits on its front, from a point in each of its sixteenths, drawn by a hash: points of a grid
/// would all fall on bars of a grating, or between them.
glm::vec3 mean_radiance(const Scene& scene, const Piece& piece, std::size_t index) {
    const auto& [a, b, c] = piece.corners;
    const glm::vec2 along = 0.25f * (b - a);
    const glm::vec2 across = 0.25f * (c - a);
    glm::vec3 sum(0.0f);
    std::uint64_t drawn = 0;
    const auto add = [&](const glm::vec2& corner, float side) {
        const std::uint64_t bits = lightcuts::hash_keys(piece.triangle, index, drawn++);
        auto s = static_cast<float>(lightcuts::to_unit(bits));
        auto t = static_cast<float>(lightcuts::to_unit(lightcuts::mix_bits(bits)));
        if (s + t > 1.0f) {
            s = 1.0f - s;
            t = 1.0f - t;
        }
        const glm::vec2 at = corner + side * (s * along + t * across);
        sum += emitted_radiance(scene, piece.triangle, at.x, at.y, true);
    };
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4 - i; ++j) {
            const glm::vec2 corner = a + static_cast<float>(i) * along + static_cast<float>(j) * across;
            add(corner, 1.0f);
            if (i + j < 3) add(corner + along + across, -1.0f);  // the one that stands on its head
        }
    }
    return sum / 16.0f;
}

/// One point in each of `count` equal parts of the pieces' total weight; `visit(point, index of its piece)`. Where
/// `accepts(triangle, barycentric point)` refuses the point, another of the same piece is tried.
template <class Accepts, class Visit>
void visit_strata(const Scene& scene, const std::vector<Piece>& pieces, const std::vector<double>& weights,
                  std::size_t count, Accepts&& accepts, Visit&& visit) {
    constexpr int most_tries = 16;
    constexpr double golden = 0.6180339887498949;
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::size_t at = 0;
    double before = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double wanted = total * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
        while (at + 1 < pieces.size() && before + weights[at] <= wanted) before += weights[at++];
        const double rest = weights[at] > 0.0 ? std::clamp((wanted - before) / weights[at], 0.0, 1.0) : 0.5;
        const double turn = golden * static_cast<double>(i);
        const Piece& piece = pieces[at];
        const auto point = [&](double along, double across) {
            const double s = std::sqrt(along);
            const double t = s * across;
            return (1.0 - s) * dvec2(piece.corners[0]) + (s - t) * dvec2(piece.corners[1]) +
                   t * dvec2(piece.corners[2]);
        };
        dvec2 place = point(rest, turn - std::floor(turn));
        for (int tries = 1; tries < most_tries && !accepts(piece.triangle, place); ++tries) {
            const std::uint64_t bits = lightcuts::hash_keys(piece.triangle, i, static_cast<std::uint64_t>(tries));
            place = point(lightcuts::to_unit(bits), lightcuts::to_unit(lightcuts::mix_bits(bits)));
        }
        const Face f = face(scene, piece.triangle);
        AreaSample sample;
        sample.position = glm::vec3(f.at(place));
        sample.normal = glm::vec3(glm::normalize(glm::cross(f.b - f.a, f.c - f.a)));
        sample.triangle = piece.triangle;
        visit(sample, at);
    }
}

/// Pieces are this much smaller than a point's share, so that a share is a compact patch.
constexpr double pieces_per_point = 4.0;
/// Least number of pieces of an emitter whose radiance varies, which is taken as constant over each; fewer where so
/// few lights are wanted that there must be very many emitters.
constexpr double least_varying_pieces = 4096.0;
constexpr double varying_pieces_per_point = 256.0;

bool is_varying(const Scene& scene, std::span<const std::uint32_t> triangles) {
    return std::any_of(triangles.begin(), triangles.end(), [&](std::uint32_t t) {
        return has_varying_emission(scene, scene.materials[scene.triangle_material[t]]);
    });
}

}  // namespace

double triangle_area(const Scene& scene, std::uint32_t t) { return area_of(face(scene, t)); }

std::vector<AreaSample> spread_by_area(const Scene& scene, std::span<const std::uint32_t> triangles,
                                       std::size_t count) {
    if (count == 0 || triangles.empty()) return {};
    std::vector<AreaSample> samples = spread_on_flat(scene, triangles, count);
    if (!samples.empty()) return samples;
    const std::vector<Piece> pieces = cut_and_sort(scene, triangles,
                                                   1.0 / (pieces_per_point * static_cast<double>(count)));
    if (pieces.empty()) return {};
    std::vector<double> areas;
    for (const Piece& piece : pieces) areas.push_back(piece.area);
    const auto anywhere = [](std::uint32_t, const dvec2&) { return true; };
    visit_strata(scene, pieces, areas, count, anywhere,
                 [&](const AreaSample& s, std::size_t) { samples.push_back(s); });
    return samples;
}

std::vector<EmissionSample> spread_by_emission(const Scene& scene, std::span<const std::uint32_t> triangles,
                                               std::size_t count) {
    std::vector<EmissionSample> samples;
    if (!is_varying(scene, triangles)) {
        double area = 0;
        for (const std::uint32_t t : triangles) area += triangle_area(scene, t);
        for (const AreaSample& place : spread_by_area(scene, triangles, count)) {
            const glm::dvec3 radiance(emitted_radiance(scene, place.triangle, 1.0f / 3.0f, 1.0f / 3.0f, true));
            if (radiance == glm::dvec3(0.0)) continue;
            samples.push_back({place, glm::vec3(radiance * (area / static_cast<double>(count)))});
        }
        return samples;
    }
    const double points = static_cast<double>(count);
    const double pieces_wanted = std::max(pieces_per_point * points,
                                          std::min(varying_pieces_per_point * points, least_varying_pieces));
    const std::vector<Piece> pieces = cut_and_sort(scene, triangles, 1.0 / pieces_wanted);
    std::vector<glm::vec3> radiances;
    std::vector<double> powers;
    for (const Piece& piece : pieces) {
        radiances.push_back(mean_radiance(scene, piece, radiances.size()));
        powers.push_back(piece.area * lightcuts::channel_sum(radiances.back()));
    }
    const double share = std::accumulate(powers.begin(), powers.end(), 0.0) / static_cast<double>(count);
    if (!(share > 0.0)) return {};
    // Not in the holes of a mask.
    const auto shines = [&](std::uint32_t t, const dvec2& at) {
        return emitted_radiance(scene, t, static_cast<float>(at.x), static_cast<float>(at.y), true) != glm::vec3(0.0f);
    };
    visit_strata(scene, pieces, powers, count, shines, [&](const AreaSample& place, std::size_t piece) {
        const double scale = share / lightcuts::channel_sum(radiances[piece]);
        samples.push_back({place, glm::vec3(glm::dvec3(radiances[piece]) * scale)});
    });
    return samples;
}

double emitted_power(const Scene& scene, std::span<const std::uint32_t> triangles) {
    double power = 0;
    const std::size_t draws = is_varying(scene, triangles) ? 1 + 63 / triangles.size() : 1;
    for (const std::uint32_t t : triangles) {
        double sum = 0;
        for (std::size_t i = 0; i < draws; ++i) {
            glm::vec2 at(1.0f / 3.0f);
            if (draws > 1) {
                const std::uint64_t bits = lightcuts::hash_keys(t, i);
                const auto s = static_cast<float>(std::sqrt(lightcuts::to_unit(bits)));
                const auto u = static_cast<float>(lightcuts::to_unit(lightcuts::mix_bits(bits)));
                at = {s * (1.0f - u), s * u};
            }
            sum += lightcuts::channel_sum(emitted_radiance(scene, t, at.x, at.y, true));
        }
        power += triangle_area(scene, t) * sum / static_cast<double>(draws);
    }
    return power;
}

}  // namespace render
