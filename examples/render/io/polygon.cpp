#include "io/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace render {
namespace {

using glm::dvec2;
using glm::dvec3;
using Triangle = std::array<std::uint32_t, 3>;

/// Twice the signed area of a triangle.
double turn(const dvec2& a, const dvec2& b, const dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The outline seen from where it runs counter-clockwise, along the axis nearest to its normal [Newell]: two of the
/// three coordinates as they are, so that nothing is rounded.
std::vector<dvec2> flattened(std::span<const dvec3> outline) {
    dvec3 normal(0.0);
    for (std::size_t i = 0; i < outline.size(); ++i) {
        // About one corner, so that outlines far from the origin of coordinates keep their digits.
        const dvec3 a = outline[i] - outline[0];
        const dvec3 b = outline[(i + 1) % outline.size()] - outline[0];
        normal += glm::cross(a, b);
    }
    const dvec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const int u = normal[axis] >= 0.0 ? (axis + 1) % 3 : (axis + 2) % 3;
    const int v = normal[axis] >= 0.0 ? (axis + 2) % 3 : (axis + 1) % 3;
    std::vector<dvec2> flat;
    flat.reserve(outline.size());
    for (const dvec3& p : outline) flat.emplace_back(p[u], p[v]);
    return flat;
}

bool is_convex_fan(const std::vector<dvec2>& p) {
    const std::size_t n = p.size();
    for (std::size_t i = 0; i < n; ++i) {
        if (turn(p[i], p[(i + 1) % n], p[(i + 2) % n]) < 0.0) return false;
        // Outlines that go around more than once turn left all the way, too; and a fan's triangles shall have an area,
        // so that every corner on a straight edge stays the corner of a triangle, where neighboring faces have it.
        if (i + 2 < n && !(turn(p[0], p[i + 1], p[i + 2]) > 0.0)) return false;
    }
    return true;
}

class EarClipper {
public:
    explicit EarClipper(std::vector<dvec2> points) : points_(std::move(points)) {
        const auto n = static_cast<std::uint32_t>(points_.size());
        before_.resize(n);
        after_.resize(n);
        for (std::uint32_t i = 0; i < n; ++i) {
            before_[i] = (i + n - 1) % n;
            after_[i] = (i + 1) % n;
        }
        for (std::uint32_t i = 0; i < n; ++i) {
            if (turn_at(i) < 0.0) inward_.push_back(i);
        }
        std::sort(inward_.begin(), inward_.end(),
                  [&](std::uint32_t a, std::uint32_t b) { return points_[a].x < points_[b].x; });
    }

    std::vector<Triangle> clip() {
        std::uint32_t left = static_cast<std::uint32_t>(points_.size());
        std::uint32_t at = 0;
        std::uint32_t since_last = 0;
        Demand demand = Demand::clear;
        while (left > 3) {
            if (is_acceptable(at, demand)) {
                const std::uint32_t next = after_[at];
                cut(at);
                --left;
                // Going on beyond the neighbor makes triangles less thin than a fan's.
                at = after_[next];
                since_last = 0;
                demand = Demand::clear;
            } else {
                at = after_[at];
                if (++since_last > left) {
                    since_last = 0;
                    demand = static_cast<Demand>(static_cast<int>(demand) + 1);
                }
            }
        }
        triangles_.push_back({before_[at], at, after_[at]});
        return std::move(triangles_);
    }

private:
    /// What may be cut off, less and less choosy: ears with nothing in or at them; ears with nothing in them; ears of
    /// no area; and, of an outline that crosses itself, any corner.
    enum class Demand { clear, ear, flat, any };

    double turn_at(std::uint32_t i) const { return turn(points_[before_[i]], points_[i], points_[after_[i]]); }

    bool is_acceptable(std::uint32_t i, Demand demand) const {
        if (demand == Demand::any) return true;
        const double area = turn_at(i);
        if (demand == Demand::flat) return area == 0.0;
        return area > 0.0 && is_empty(i, demand == Demand::clear ? rounding : 0.0);
    }

    /// No corner that bends inwards lies in the ear or on the cut, or nearer to it than `slack` of its length. Corners
    /// where its own are, at bridges to holes, do not count: what is beyond them does.
    bool is_empty(std::uint32_t i, double slack) const {
        const dvec2& a = points_[before_[i]];
        const dvec2& b = points_[i];
        const dvec2& c = points_[after_[i]];
        const double least = -slack * (glm::dot(b - a, b - a) + glm::dot(c - b, c - b));
        const double low = std::min({a.x, b.x, c.x});
        const double high = std::max({a.x, b.x, c.x});
        auto candidate = std::lower_bound(inward_.begin(), inward_.end(), low,
                                          [&](std::uint32_t k, double x) { return points_[k].x < x; });
        for (; candidate != inward_.end() && points_[*candidate].x <= high; ++candidate) {
            const dvec2& p = points_[*candidate];
            if (after_[*candidate] == gone || p == a || p == b || p == c) continue;
            if (turn(a, b, p) > least && turn(b, c, p) > least && turn(c, a, p) >= least) return false;
        }
        return true;
    }

    void cut(std::uint32_t i) {
        triangles_.push_back({before_[i], i, after_[i]});
        after_[before_[i]] = after_[i];
        before_[after_[i]] = before_[i];
        after_[i] = gone;
    }

    static constexpr std::uint32_t gone = ~0u;
    static constexpr double rounding = 1e-9;

    std::vector<dvec2> points_;
    std::vector<std::uint32_t> before_;
    std::vector<std::uint32_t> after_;
    std::vector<std::uint32_t> inward_;  ///< corners that bend inwards at first, by x; cutting makes no new ones
    std::vector<Triangle> triangles_;
};

std::vector<Triangle> fan(std::uint32_t count) {
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 2; i < count; ++i) triangles.push_back({0, i - 1, i});
    return triangles;
}

}  // namespace

std::vector<std::array<std::uint32_t, 3>> triangles_of(std::span<const glm::dvec3> outline) {
    if (outline.size() == 3) return {{0, 1, 2}};
    std::vector<dvec2> flat = flattened(outline);
    if (is_convex_fan(flat)) return fan(static_cast<std::uint32_t>(outline.size()));
    return EarClipper(std::move(flat)).clip();
}

}  // namespace render
