#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "../core/invalid_input.hpp"
#include "../core/random.hpp"
#include "../core/vector.hpp"
#include "../source/spatial_order.hpp"
#include "triangle_surface.hpp"

namespace lightcuts {

/// A point of a triangle mesh: (1 - u - v) a + u b + v c on the corners a, b, c of its triangle.
struct SurfaceSample {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};  ///< unit, of the side from which the triangle's corners run counter-clockwise
    std::uint32_t triangle = 0;
    float u = 0.0f, v = 0.0f;  ///< >= 0, with a sum of at most 1

    bool operator==(const SurfaceSample&) const = default;
};

/// Points spread evenly over a surface.
struct EvenPoints {
    std::vector<SurfaceSample> points;
    double area = 0.0;  ///< that each of them stands for, in squared units of the mesh
};

namespace detail {

/// Points of the parts of a surface in hashed cubic cells, so that those within the cells' size of a place are found
/// whatever the surface's extent.
class PartGrid {
public:
    explicit PartGrid(double size) : size_(size) {}

    /// `place(i)`: a position; `part(i)`. cost: O(count).
    template <class Place, class Part>
    void fill(std::size_t count, const Place& place, const Part& part) {
        cells_.resize(count);
        order_.resize(count);
        mask_ = std::bit_ceil((std::max)(count, std::size_t{1})) - 1;
        begin_.assign(mask_ + 2, 0);
        for (std::size_t i = 0; i < count; ++i) {
            cells_[i] = name(part(i), cell_of(place(i)));
            ++begin_[(cells_[i] & mask_) + 1];
        }
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        next_.assign(begin_.begin(), begin_.end() - 1);
        for (std::size_t i = 0; i < count; ++i) order_[next_[cells_[i] & mask_]++] = static_cast<std::uint32_t>(i);
    }

    /// Calls f(i) for the points of `part` in the cells about `place`, and perhaps some others; at most 32 a cell, so
    /// that crumpled surfaces cost no more than others.
    template <class F>
    void for_each_near(const glm::dvec3& place, std::uint32_t part, F&& f) const {
        constexpr int most = 32;
        const std::array<std::int64_t, 3> middle = cell_of(place);
        for (int k = 0; k < 27; ++k) {
            const std::uint64_t cell = name(part,
                                            {middle[0] + k % 3 - 1, middle[1] + k / 3 % 3 - 1, middle[2] + k / 9 - 1});
            int found = 0;
            for (std::uint32_t i = begin_[cell & mask_]; i < begin_[(cell & mask_) + 1] && found < most; ++i) {
                if (cells_[order_[i]] != cell) continue;
                f(order_[i]);
                ++found;
            }
        }
    }

private:
    std::array<std::int64_t, 3> cell_of(const glm::dvec3& place) const {
        std::array<std::int64_t, 3> cell;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double at = std::floor(place[static_cast<int>(axis)] / size_);
            cell[axis] = static_cast<std::int64_t>(std::fmod(at, 0x1p40));
        }
        return cell;
    }
    static std::uint64_t name(std::uint32_t part, const std::array<std::int64_t, 3>& cell) {
        return hash_keys(part, cell[0], cell[1], cell[2]);
    }

    double size_;
    std::size_t mask_ = 0;
    std::vector<std::uint64_t> cells_;
    std::vector<std::uint32_t> begin_, next_, order_;
};

/// The weights of the corners at `share`, in [0, 1), of the way along the curve of Sierpinski that fills a triangle:
/// equal shares pass equal areas, and what is near along the curve is near in the triangle.
inline std::array<double, 3> along_filling_curve(const SurfaceTriangle& triangle, double share) {
    std::size_t longest = 0;
    double length2 = -1.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 edge = triangle.edge_end(k) - triangle.edge_begin(k);
        if (glm::dot(edge, edge) > length2) {
            length2 = glm::dot(edge, edge);
            longest = k;
        }
    }
    std::array<glm::dvec3, 3> corner{};  // the curve's begin, the one beside it, its end
    for (std::size_t k = 0; k < 3; ++k) corner[k][static_cast<int>((longest + 1 + 2 * k) % 3)] = 1.0;
    for (int level = 0; level < 44; ++level) {
        const glm::dvec3 middle = 0.5 * (corner[0] + corner[2]);
        share *= 2.0;
        if (share < 1.0) {
            corner = {corner[0], middle, corner[1]};
        } else {
            share -= 1.0;
            corner = {corner[1], middle, corner[2]};
        }
    }
    return {corner[1].x, corner[1].y, corner[1].z};
}

/// The triangles that have an area in an order in which those of a part follow each other, and in it those that face
/// alike and lie close together.
inline std::vector<std::uint32_t> surface_order(const TriangleSurface& surface) {
    std::vector<OrientedPlace> places;
    std::vector<std::uint32_t> triangles;
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-std::numeric_limits<double>::infinity());
    for (std::uint32_t t = 0; t < surface.size(); ++t) {
        if (!(surface[t].area > 0.0)) continue;
        const auto& [a, b, c] = surface[t].corners;
        const glm::dvec3 middle = (a + b + c) / 3.0;
        triangles.push_back(t);
        places.push_back({middle, surface[t].side * surface[t].normal});
        low = (glm::min)(low, middle);
        high = (glm::max)(high, middle);
    }
    if (triangles.empty()) return {};
    const glm::dvec3 extent = high - low;
    const double size = (std::max)({extent.x, extent.y, extent.z});
    constexpr auto unseen = static_cast<std::uint32_t>(-1);
    std::vector<std::uint32_t> rank(surface.part_count(), unseen);
    std::vector<std::uint32_t> order = spatial_order(places, low, size > 0.0 ? size : 1.0);
    std::uint32_t next = 0;
    for (std::uint32_t& t : order) {
        t = triangles[t];
        std::uint32_t& own = rank[surface[t].part];
        if (own == unseen) own = next++;
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return rank[surface[a].part] < rank[surface[b].part]; });
    return order;
}

/// One random place in each of `count` equal shares of the area.
inline std::vector<SurfacePlace> stratified_places(const TriangleSurface& surface, std::span<const std::uint32_t> order,
                                                   double area, std::size_t count, std::uint64_t seed) {
    std::vector<SurfacePlace> places(count);
    std::size_t at = 0;
    double before = 0.0;  // area of the triangles in front of `at`
    for (std::size_t i = 0; i < count; ++i) {
        const double wanted = (static_cast<double>(i) + uniform01(hash_keys(seed, i))) / static_cast<double>(count) *
                              area;
        while (at + 1 < order.size() && wanted >= before + surface[order[at]].area) before += surface[order[at++]].area;
        const SurfaceTriangle& t = surface[order[at]];
        const double share = std::clamp((wanted - before) / t.area, 0.0, 1.0 - 0x1p-53);
        places[i] = {order[at], along_filling_curve(t, share)};
    }
    return places;
}

/// Places beside the borders of a surface, `outside` of them, at equal distances of `spacing` or as few as `most`.
struct BorderPost {
    glm::dvec3 place;
    std::uint32_t triangle;
};
inline std::vector<BorderPost> border_posts(const TriangleSurface& surface, std::span<const std::uint32_t> order,
                                            double spacing, double outside, std::size_t most) {
    const auto for_each_border = [&](auto&& f) {
        for (const std::uint32_t t : order) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (surface[t].across[k] == SurfaceTriangle::none) {
                    f(t, surface[t].edge_begin(k), surface[t].edge_end(k), surface[t].outwards(k));
                }
            }
        }
    };
    double length = 0.0;
    for_each_border([&](std::uint32_t, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3&) {
        length += glm::distance(a, b);
    });
    const double step = (std::max)(spacing, length / static_cast<double>(most));
    std::vector<BorderPost> posts;
    double next = 0.5 * step;  // from the edge's begin
    for_each_border([&](std::uint32_t t, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& outwards) {
        const double own = glm::distance(a, b);
        for (; next < own; next += step) posts.push_back({a + (next / own) * (b - a) + outside * outwards, t});
        next -= own;
    });
    return posts;
}

/// Moves places apart within the surface, step by step.
inline void spread(const TriangleSurface& surface, std::span<const std::uint32_t> order, double spacing, int steps,
                   std::vector<SurfacePlace>& places) {
    // A border pushes as the rest of the surface would if it went on there, so that the outermost places lie half of a
    // row inside of it and stand for as much area as others. Posts on the border itself would hold what came upon it.
    constexpr double posts_a_spacing = 2.0, push_of_post = 0.6, outside = 0.43;
    const double reach = 2.0 * spacing;
    const std::vector<BorderPost> posts = border_posts(surface, order, spacing / posts_a_spacing, outside * spacing,
                                                       4 * places.size());
    PartGrid grid(reach), post_grid(reach);
    post_grid.fill(
        posts.size(), [&](std::size_t i) { return posts[i].place; },
        [&](std::size_t i) { return surface[posts[i].triangle].part; });
    std::vector<glm::dvec3> at(places.size()), pushes(places.size());
    for (int step = 0; step < steps; ++step) {
        for (std::size_t i = 0; i < places.size(); ++i) at[i] = surface[places[i].triangle].at(places[i].weights);
        grid.fill(
            places.size(), [&](std::size_t i) { return at[i]; },
            [&](std::size_t i) { return surface[places[i].triangle].part; });
        for (std::size_t i = 0; i < places.size(); ++i) {
            const SurfaceTriangle& own = surface[places[i].triangle];
            glm::dvec3 push(0.0);
            const auto add = [&](const glm::dvec3& from, const SurfaceTriangle& other, double weight) {
                const glm::dvec3 away = at[i] - from;
                const double distance2 = glm::dot(away, away);
                if (!(distance2 < reach * reach) || !(distance2 > 0.0)) return;
                // The other side of a thin body is far along the surface.
                if (other.part != own.part || !(other.side * own.side * glm::dot(other.normal, own.normal) > 0.0)) {
                    return;
                }
                const double distance = std::sqrt(distance2), closeness = 1.0 - distance / reach;
                push += away * (weight * closeness * closeness / distance);
            };
            grid.for_each_near(at[i], own.part, [&](std::uint32_t j) {
                if (j != i) add(at[j], surface[places[j].triangle], 1.0);
            });
            post_grid.for_each_near(at[i], own.part, [&](std::uint32_t j) {
                add(posts[j].place, surface[posts[j].triangle], push_of_post);
            });
            push -= glm::dot(push, own.normal) * own.normal;
            // All move at once, and ever less, or they would swing to and fro.
            push *= spacing * 0.5 * (1.0 - static_cast<double>(step) / static_cast<double>(steps));
            const double length = glm::length(push), most = 0.5 * spacing;
            pushes[i] = length > most ? push * (most / length) : push;
        }
        for (std::size_t i = 0; i < places.size(); ++i) walk(surface, places[i], pushes[i]);
    }
}

inline SurfaceSample sample_at(const TriangleSurface& surface, const SurfacePlace& place) {
    const SurfaceTriangle& t = surface[place.triangle];
    SurfaceSample sample;
    sample.triangle = place.triangle;
    sample.u = static_cast<float>(place.weights[1]);
    sample.v = (std::min)(static_cast<float>(place.weights[2]), 1.0f - sample.u);
    const double u = static_cast<double>(sample.u), v = static_cast<double>(sample.v);
    sample.position = glm::vec3(t.at({1.0 - u - v, u, v}));
    sample.normal = glm::vec3(t.normal);
    return sample;
}

}  // namespace detail

/// Points spread evenly by area over the surface of a triangle mesh, for a tree over surfaces [Cut merging 2008,
/// section 4.1]: random ones, one in each of `count` equal shares of the area along a curve that fills the surface,
/// which then repel their neighbors and move within the surface, across the edges of triangles. Each stands for the
/// same area. `corners(i)`: of triangle i of `triangles`, indexable, three `Vector3`. `steps`: 0 leaves the points as
/// they are drawn, when the expected number of points of any patch is exactly its share of the area.
///
/// Points stay in their part of the surface, which ends where it has a border or an edge at which it turns by 60
/// degrees or more; vertices in one place connect. So of thousands of small parts each has its share, to within two.
/// Only points of one part repel each other, and of these only those that face within 90 degrees: the two sides of a
/// thin body are apart. Ends of a part push back, so that points are no denser there. A triangle so thin that it has no
/// normal has no points. The same on every run for a seed.
///
/// throws: invalid_input naming a triangle with a corner that is not finite, or if none has an area and `count` > 0.
/// cost: O(triangles log(triangles) + count x steps); a step of a point looks at some 40 neighbors, at most at 1728,
/// and crosses at most 64 edges.
template <std::invocable<std::size_t> Corners>
    requires requires(const Corners& corners, std::size_t i) {
        requires Vector3<std::remove_cvref_t<decltype(corners(i)[0])>>;
    }
EvenPoints even_points(std::size_t triangles, const Corners& corners, std::size_t count, std::uint64_t seed = 0,
                       int steps = 20) {
    const detail::TriangleSurface surface(
        triangles, [&](std::size_t i, std::size_t k) { return glm::dvec3(to_vec3(corners(i)[k])); });
    if (count == 0) return {};
    const std::vector<std::uint32_t> order = detail::surface_order(surface);
    double area = 0.0;
    for (const std::uint32_t t : order) area += surface[t].area;
    if (!(area > 0.0)) LIGHTCUTS_THROW(invalid_input("even points: no triangle of the mesh has an area"));
    EvenPoints result;
    result.area = area / static_cast<double>(count);
    std::vector<detail::SurfacePlace> places = detail::stratified_places(surface, order, area, count, seed);
    // Between neighbors of a hexagonal lattice.
    detail::spread(surface, order, std::sqrt(result.area * 2.0 / std::sqrt(3.0)), steps, places);
    result.points.reserve(count);
    for (const detail::SurfacePlace& place : places) result.points.push_back(detail::sample_at(surface, place));
    return result;
}

}  // namespace lightcuts
