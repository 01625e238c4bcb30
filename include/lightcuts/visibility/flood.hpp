#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <glm/vec3.hpp>

#include "../core/assertion.hpp"
#include "../core/box.hpp"
#include "occluder_mesh.hpp"
#include "oracle.hpp"
#include "shaft.hpp"

namespace lightcuts {

/// Below which receivers reflect nothing: from light at `b` to a receiver at `p`, if dot(normal, b - p) <= 0.
struct Horizon {
    glm::vec3 normal;  ///< not zero
    Box positions;     ///< of the receivers, not where their shadow rays start
};

/// Where shadow rays of some receivers start.
struct ReceiverBox {
    Box box;
    /// One for all of them, if there is one: what is below need not be hidden.
    std::optional<Horizon> horizon = {};
};

/// How lights are proved to be hidden.
struct FloodOptions {
    /// A proof does not use a triangle in whose plane a receiver or, of triangles that reach them, a light lies, within
    /// this times the largest coordinate. At least 1e-12.
    double margin = 2e-6;
    /// Shadow rays may end before their light by this part of their length, below 1: what is nearer to a light hides
    /// nothing.
    double untraced_end = 1e-3;
    /// Shadow rays may end so far from their light, in any direction: off the surface that it lies on, or where they
    /// enter the sphere that it lies in. World units, not negative.
    double end_distance = 0.0;
    /// A walk over more triangles is given up; from 1 to `Flood::most_triangles`.
    std::uint32_t max_triangles = 400;
};

/// Proves that all lights of a box are hidden from all receivers of a box, by a walk over triangles.
///
/// A sheet of triangles that share edges hides what is behind it if it has neither a border nor a fold in the shaft
/// between receivers and lights. For take a segment from a receiver to a light that one of its triangles blocks, and
/// move both ends to another receiver and another light: the point where the segment is blocked moves over the sheet,
/// and at each edge passes on to the triangle on the other side. All predicates are rounded such that doubt ends a
/// proof. Never wrong, but for rays whose own rounding lets them pass an edge that they meet; and often without an
/// answer: what several sheets hide together is not found. A view of the mesh.
class Flood {
public:
    using Index = OccluderMesh::Index;

    static constexpr std::size_t most_triangles = 512;

    explicit Flood(const OccluderMesh& mesh, const FloodOptions& options = {}) : mesh_(mesh), options_(options) {
        LIGHTCUTS_ASSERT(options.margin >= 1e-12 && options.untraced_end >= 0.0 && options.untraced_end < 1.0);
        LIGHTCUTS_ASSERT(options.end_distance >= 0.0);
        LIGHTCUTS_ASSERT(options.max_triangles >= 1 && options.max_triangles <= most_triangles);
    }
    /// It would refer to what is gone.
    explicit Flood(const OccluderMesh&&, const FloodOptions& = {}) = delete;

    /// True only if every segment from a point of `receivers.box` to one of `lights`, a Box, short of its untraced end,
    /// crosses a triangle; or every ray in a direction of `lights`, a DirectionBox; but for those to lights below the
    /// horizon. `start`: a triangle that start_segment() crosses; if it does not, the answer is false. threads: safe.
    /// cost: some 20 ns for each triangle that the walk meets, and that of `prepare`; allocates nothing
    template <class Lights>
    bool hides(const ReceiverBox& receivers, const Lights& lights, Index start) const {
        const std::optional<Passage> passage = prepare(receivers, lights);
        return passage && walk(*passage, start).hides;
    }

    /// True if there are no receivers or no lights.
    static bool is_empty_problem(const ReceiverBox& receivers, const Box& lights) {
        return is_empty(receivers.box) || is_empty(lights);
    }
    static bool is_empty_problem(const ReceiverBox& receivers, const DirectionBox& lights) {
        return is_empty_problem(receivers, lights.box);
    }

    /// Between a receiver and a light; or a ray in a direction.
    struct Segment {
        glm::dvec3 from;
        glm::dvec3 to;         ///< a place, or a direction
        bool distant = false;  ///< it is a direction
        bool exists = false;   ///< false if all lights are below the horizon, or the ends coincide

        glm::dvec3 way() const { return distant ? to : to - from; }
    };

    /// The segment from the middle of the receivers to that of the lights; where that is below the horizon, to the
    /// corner of their box that is highest above it.
    static Segment start_segment(const ReceiverBox& receivers, const Box& lights) {
        return start_segment(receivers, lights, false);
    }
    static Segment start_segment(const ReceiverBox& receivers, const DirectionBox& lights) {
        return start_segment(receivers, lights.box, true);
    }

    /// What lies between receivers and lights, prepared for walks from several triangles.
    class Passage {
    public:
        const Segment& start_segment() const { return segment_; }

    private:
        friend class Flood;

        template <class Lights>
        Passage(const ReceiverBox& receivers, const Lights& ends, const Segment& segment, double reach, double margin)
            : receivers_(receivers.box), light_ends_(box_of_lights(ends)), segment_(segment), reach_(reach),
              margin_(margin), shaft_(receivers.box, ends, reach) {}

        Box receivers_;
        Box light_ends_;  ///< where rays to lights may end, and what is nearer than their untraced ends; or directions
        Segment segment_;
        double reach_;   ///< no coordinate is larger
        double margin_;  ///< distance
        Shaft shaft_;
    };

    /// Nothing if no triangle can hide these lights, or none need be hidden. `lights`: a Box or a DirectionBox. cost:
    /// some 150 ns
    template <class Lights>
    std::optional<Passage> prepare(const ReceiverBox& receivers, const Lights& lights) const {
        if (is_empty_problem(receivers, lights)) return std::nullopt;
        const Segment segment = start_segment(receivers, lights);
        if (!segment.exists) return std::nullopt;
        const Lights ends = grown(lights);
        const Box& box = box_of_lights(ends);
        // From one direction to its opposite there is no way but through none.
        if (segment.distant && !(min_distance2({glm::dvec3(box.lo), glm::dvec3(box.hi)}) > 1e-4)) return std::nullopt;
        double reach = mesh_.reach();
        for (int axis = 0; axis < 3; ++axis) {
            reach = detail::larger(reach, magnitude(receivers.box, axis));
            if (!segment.distant) reach = detail::larger(reach, magnitude(box, axis));
        }
        if (!(reach > 0.0) || !(reach < 1e18)) return std::nullopt;  // squares of lengths are numbers
        Passage passage(receivers, ends, segment, reach, options_.margin * reach);
        if (!segment.distant) passage.light_ends_ = with_ends(receivers.box, box);
        if (receivers.horizon) {
            const glm::dvec3 normal(receivers.horizon->normal);
            // A ray to a light above the horizon may end below it.
            const double least = Shaft::lowest(receivers.horizon->positions, normal) -
                                 options_.end_distance * std::sqrt(detail::dot(normal, normal));
            passage.shaft_.cut_below(receivers.horizon->normal, least, receivers.box, ends);
        }
        return passage;
    }

    /// What a walk has shown.
    struct Walk {
        bool hides = false;           ///< see `Flood::hides`
        std::uint32_t triangles = 0;  ///< met
    };

    /// The walk from `start`, for the receivers and lights that `passage` was prepared for, by this very Flood.
    Walk walk(const Passage& passage, Index start) const {
        if (start >= mesh_.size() || !blocks_start_segment(passage, start)) return {};
        const Side side = side_of(passage, plane_of(start, passage.reach_), start);
        if (side == Side::unknown) return {};
        const std::size_t most = options_.max_triangles < most_triangles ? options_.max_triangles : most_triangles;
        Met met;
        const OccluderMesh::HalfEdge first = 3 * start;
        met.add({start,
                 side,
                 no_corner,
                 {passage.shaft_.outside(mesh_.start(first)), passage.shaft_.outside(mesh_.start(first + 1)),
                  passage.shaft_.outside(mesh_.start(first + 2))}});
        for (std::size_t i = 0; i < met.size(); ++i) {
            const Member member = met[i];
            for (std::uint8_t k = 0; k < 3; ++k) {
                // The triangle that the walk came from is beyond this edge.
                if (k == member.entry) continue;
                const OccluderMesh::HalfEdge edge = 3 * member.triangle + k;
                const Shaft::Outside from = member.outside[k], to = member.outside[(k + 1u) % 3];
                if (!passage.shaft_.may_hold(mesh_.start(edge), from, mesh_.end(edge), to)) continue;
                const Continuation next = continuation(passage, edge, member.side, met);
                if (next.side == Side::unknown) return {false, static_cast<std::uint32_t>(met.size())};
                const Index triangle = OccluderMesh::triangle_of(next.edge);
                if (met.contains(triangle)) continue;
                if (met.size() >= most) return {false, static_cast<std::uint32_t>(met.size())};
                const bool alike = mesh_.run_alike(edge, next.edge);
                const std::size_t entry = next.edge % 3;
                Member beyond{triangle, next.side, static_cast<std::uint8_t>(entry), {}};
                beyond.outside[entry] = alike ? from : to;
                beyond.outside[(entry + 1) % 3] = alike ? to : from;
                beyond.outside[(entry + 2) % 3] = passage.shaft_.outside(
                    mesh_.start(OccluderMesh::next_of_triangle(OccluderMesh::next_of_triangle(next.edge))));
                met.add(beyond);
            }
        }
        return {true, static_cast<std::uint32_t>(met.size())};
    }

    /// A place on the segment just behind a triangle that it crosses, where another ray along it may start.
    std::optional<glm::vec3> place_behind(const Segment& segment, Index triangle) const {
        const Plane plane = plane_of(triangle, mesh_.reach());
        const glm::dvec3 way = segment.way();
        const double slope = detail::dot(plane.normal, way);
        const double at = -plane.at(segment.from) / slope;
        if (!(at > 0.0) || !(at < (segment.distant ? 1e18 : 1.0))) return std::nullopt;
        const double step = 1e-5 * mesh_.reach() / std::sqrt(detail::dot(way, way));
        return glm::vec3(segment.from + (at + step) * way);
    }

private:
    /// On which side of a triangle's plane all receivers are.
    enum class Side : std::int8_t { unknown = 0, positive = 1, negative = -1 };

    static constexpr std::uint8_t no_corner = 3;

    /// A triangle of a sheet.
    struct Member {
        Index triangle;
        Side side;
        std::uint8_t entry;                     ///< the corner where the edge starts that the walk came over
        std::array<Shaft::Outside, 3> outside;  ///< of the corners
    };

    /// An edge of the triangle beyond an edge.
    struct Continuation {
        OccluderMesh::HalfEdge edge;
        Side side;  ///< unknown if there is none
    };

    /// The triangles that a walk has met.
    class Met {
    public:
        Met() { slots_.fill(empty); }

        /// pre: it has not been met; there are fewer than `most_triangles`
        void add(const Member& member) {
            slots_[slot_of(member.triangle)] = static_cast<std::uint16_t>(count_);
            members_[count_++] = member;
        }
        bool contains(Index triangle) const { return slots_[slot_of(triangle)] != empty; }
        /// Unknown of a triangle that has not been met.
        Side side_of(Index triangle) const {
            const std::uint16_t number = slots_[slot_of(triangle)];
            return number == empty ? Side::unknown : members_[number].side;
        }
        std::size_t size() const { return count_; }
        const Member& operator[](std::size_t i) const { return members_[i]; }

    private:
        static constexpr std::uint16_t empty = 0xffff;

        /// Where it is, or would be.
        std::size_t slot_of(Index triangle) const {
            std::size_t slot = (triangle * 0x9e3779b1u) >> 22;
            while (slots_[slot] != empty && members_[slots_[slot]].triangle != triangle) {
                slot = (slot + 1) % slots_.size();
            }
            return slot;
        }

        std::array<std::uint16_t, 1024> slots_;
        std::array<Member, most_triangles> members_;
        std::size_t count_ = 0;
    };

    static const Box& box_of_lights(const DirectionBox& lights) { return lights.box; }
    static const Box& box_of_lights(const Box& lights) { return lights; }

    /// The triangle beyond an edge, as all receivers see it; one that has been met, if possible. None if there is none
    /// that blocks rays short of the lights.
    Continuation continuation(const Passage& passage, OccluderMesh::HalfEdge edge, Side side, const Met& met) const {
        Continuation found{edge, Side::unknown};
        for (OccluderMesh::HalfEdge e = mesh_.neighbor(edge); e != edge; e = mesh_.neighbor(e)) {
            const Index other = OccluderMesh::triangle_of(e);
            // Across the edge as seen from the receivers: edges that run in opposite directions need the same side.
            const Side needed = !mesh_.run_alike(edge, e) ? side
                                : side == Side::positive  ? Side::negative
                                                          : Side::positive;
            if (other == OccluderMesh::triangle_of(edge)) continue;
            if (const Side known = met.side_of(other); known != Side::unknown) {
                if (known == needed) return {e, needed};
                continue;
            }
            if (found.side != Side::unknown) continue;
            if (side_of(passage, plane_of(other, passage.reach_), other) == needed) found = {e, needed};
        }
        return found;
    }

    /// A triangle's plane, not normalized; in double of the float corners.
    struct Plane {
        glm::dvec3 normal;
        glm::dvec3 origin;
        double length;    ///< of the normal
        double rounding;  ///< of dot(normal, x - origin), for |x| <= reach

        double at(const glm::dvec3& x) const { return detail::dot(normal, x - origin); }
    };

    Plane plane_of(Index triangle, double reach) const {
        const std::array<glm::vec3, 3> c = mesh_.corners(triangle);
        const glm::dvec3 a(c[0]), u = glm::dvec3(c[1]) - a, v = glm::dvec3(c[2]) - a;
        const glm::dvec3 normal(u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x);
        // A normal of a sliver is off by so much, whatever its own length.
        const double sides = std::sqrt(detail::dot(u, u) * detail::dot(v, v));
        return {normal, a, std::sqrt(detail::dot(normal, normal)), 64.0 * unit_roundoff * sides * reach};
    }

    /// The side of a triangle on which all receivers are; unknown also if lights, or the untraced ends of rays to them,
    /// may touch it.
    Side side_of(const Passage& passage, const Plane& plane, Index triangle) const {
        const double doubt = plane.length * passage.margin_ + plane.rounding;
        const auto [least, largest] = range_over(plane, passage.receivers_);
        // A triangle without area has no sides.
        if (!(plane.length > 0.0) || !(least > doubt || largest < -doubt)) return Side::unknown;
        if (!is_clear_of_lights(passage, plane, triangle)) return Side::unknown;
        return least > 0.0 ? Side::positive : Side::negative;
    }

    struct Range {
        double least;
        double largest;
    };
    static Range range_over(const Plane& plane, const Box& box) {
        const glm::dvec3 half = 0.5 * extent(box);
        const double middle = plane.at(center(box));
        const double spread = std::fabs(plane.normal.x) * half.x + std::fabs(plane.normal.y) * half.y +
                              std::fabs(plane.normal.z) * half.z;
        return {middle - spread, middle + spread};
    }

    /// True if no light, nor the untraced end of a ray to one, touches the triangle: by its plane, by its box, or by an
    /// axis across an edge and an edge of the lights' box [separating axes of a triangle and a box].
    bool is_clear_of_lights(const Passage& passage, const Plane& plane, Index triangle) const {
        if (passage.segment_.distant) return true;
        const double doubt = plane.length * passage.margin_ + plane.rounding;
        const auto [least, largest] = range_over(plane, passage.light_ends_);
        if (least > doubt || largest < -doubt) return true;
        const glm::dvec3 middle = center(passage.light_ends_), half = 0.5 * extent(passage.light_ends_);
        std::array<glm::dvec3, 3> corners;
        for (int k = 0; k < 3; ++k) {
            corners[static_cast<std::size_t>(k)] = glm::dvec3(mesh_.corners(triangle)[static_cast<std::size_t>(k)]) -
                                                   middle;
        }
        for (int axis = 0; axis < 3; ++axis) {
            const double a = corners[0][axis], b = corners[1][axis], c = corners[2][axis];
            const double apart = half[axis] + passage.margin_;
            if (detail::smaller(a, detail::smaller(b, c)) > apart || detail::larger(a, detail::larger(b, c)) < -apart) {
                return true;
            }
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 along = corners[(k + 1) % 3] - corners[k];
            for (int axis = 0; axis < 3; ++axis) {
                const int x = (axis + 1) % 3, y = (axis + 2) % 3;
                const double nx = -along[y], ny = along[x];
                const double here = nx * corners[k][x] + ny * corners[k][y];
                const double there = nx * corners[(k + 2) % 3][x] + ny * corners[(k + 2) % 3][y];
                const double apart = std::fabs(nx) * half[x] + std::fabs(ny) * half[y] +
                                     (std::fabs(nx) + std::fabs(ny)) * passage.margin_;
                if (detail::smaller(here, there) > apart || detail::larger(here, there) < -apart) return true;
            }
        }
        return false;
    }

    /// True if the segment between the middles certainly crosses the triangle, before the untraced end.
    bool blocks_start_segment(const Passage& passage, Index triangle) const {
        const Segment& segment = passage.segment_;
        const glm::dvec3 from = segment.from, way = segment.way();
        const double length = std::sqrt(detail::dot(way, way));
        const Plane plane = plane_of(triangle, passage.reach_);
        const double height = plane.at(from), slope = detail::dot(plane.normal, way);
        // On the way from one side to the other.
        if (!(height > 0.0 ? slope < 0.0 : slope > 0.0)) return false;
        if (!segment.distant) {
            const double left = height + slope * (1.0 - options_.untraced_end);
            const double doubt = plane.rounding * 4.0;
            if (!(height > 0.0 ? left < -doubt : left > doubt)) return false;
        }
        // Inside: the ray passes all edges on one side, by more than rounding.
        const std::array<glm::vec3, 3> c = mesh_.corners(triangle);
        const double sign = slope < 0.0 ? 1.0 : -1.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 a = glm::dvec3(c[k]) - from, b = glm::dvec3(c[(k + 1) % 3]) - from;
            const glm::dvec3 across(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
            const double doubt = 64.0 * unit_roundoff * length * std::sqrt(detail::dot(a, a) * detail::dot(b, b));
            if (!(-sign * detail::dot(across, way) > doubt)) return false;
        }
        return true;
    }

    /// Near the middle, but off it: in scenes with symmetry rays between middles meet edges, where it takes exact
    /// arithmetic to say which triangle they cross.
    static glm::dvec3 inside(const Box& box) {
        return glm::dvec3(box.lo) + extent(box) * glm::dvec3(0.4871, 0.5139, 0.4929);
    }
    static Segment start_segment(const ReceiverBox& receivers, const Box& lights, bool distant) {
        Segment segment{inside(receivers.box), inside(lights), distant, true};
        if (receivers.horizon) {
            const glm::dvec3 n(receivers.horizon->normal), position = inside(receivers.horizon->positions);
            const auto is_below = [&] { return !(detail::dot(n, distant ? segment.to : segment.to - position) > 0.0); };
            if (is_below()) {
                for (int axis = 0; axis < 3; ++axis) {
                    segment.to[axis] = static_cast<double>(n[axis] > 0.0 ? lights.hi[axis] : lights.lo[axis]);
                }
                segment.exists = !is_below();
            }
        }
        const glm::dvec3 way = segment.way();
        segment.exists = segment.exists && detail::dot(way, way) > 0.0;
        return segment;
    }

    static double magnitude(const Box& box, int axis) {
        return detail::larger(std::fabs(static_cast<double>(box.lo[axis])),
                              std::fabs(static_cast<double>(box.hi[axis])));
    }

    static DirectionBox grown(const DirectionBox& lights) { return lights; }
    /// The box of where rays to lights may end.
    Box grown(const Box& lights) const {
        if (options_.end_distance == 0.0 || is_empty(lights)) return lights;
        Box ends;
        for (int axis = 0; axis < 3; ++axis) {
            ends.lo[axis] = round_down(static_cast<double>(lights.lo[axis]) - options_.end_distance);
            ends.hi[axis] = round_up(static_cast<double>(lights.hi[axis]) + options_.end_distance);
        }
        return ends;
    }

    /// The box of lights and of what is nearer to them than the untraced end of a ray from a receiver.
    Box with_ends(const Box& receivers, const Box& lights) const {
        Box ends = lights;
        for (int axis = 0; axis < 3; ++axis) {
            const auto towards = [&](float light, float receiver) {
                const double l = static_cast<double>(light), r = static_cast<double>(receiver);
                return l + options_.untraced_end * (r - l);
            };
            const double lo = towards(lights.lo[axis], receivers.lo[axis]);
            const double hi = towards(lights.hi[axis], receivers.hi[axis]);
            if (lo < static_cast<double>(lights.lo[axis])) ends.lo[axis] = round_down(lo);
            if (hi > static_cast<double>(lights.hi[axis])) ends.hi[axis] = round_up(hi);
        }
        return ends;
    }

    const OccluderMesh& mesh_;
    FloodOptions options_;
};

}  // namespace lightcuts
