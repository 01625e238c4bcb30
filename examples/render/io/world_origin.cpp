#include "io/world_origin.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <glm/common.hpp>

#include "triangle.hpp"

namespace render {
namespace {

/// Scenes that are farther away than so many times their size may be moved.
constexpr double far = 8.0;
/// Where rays leave a triangle by this share of its size, its shadows are lost.
constexpr double lost_share = 0.02;
/// Where rays leave a triangle by more than this share of its size, light passes what stands on it.
constexpr double coarse_share = 0.1;
/// Of so many of a scene's triangles a person should know.
constexpr double many = 0.01;
/// And of any that is so many times the scene's size away.
constexpr double stray = 1000.0;

glm::dvec3 center_of(const Triangle& t) { return t.a / 3.0 + t.b / 3.0 + t.c / 3.0; }

double extent_of(const Triangle& t) {
    return largest_coordinate(glm::max(t.a, glm::max(t.b, t.c)) - glm::min(t.a, glm::min(t.b, t.c)));
}

/// Where most of some triangles are.
struct Middle {
    glm::dvec3 center{0.0};
    double size = 0;  ///< half of them lie in a cube of this size around the center

    bool is_far() const { return size > 0.0 && largest_coordinate(center) > far * size; }

    /// Near the center, in few binary digits.
    glm::dvec3 origin() const {
        const double step = std::exp2(std::floor(std::log2(size)));
        return step * glm::round(center / step);
    }
};

double median(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// As many triangles are looked at, or a few more.
constexpr std::size_t draws = 1023;

/// Drawn evenly by area: as each stands for the same area, medians over them are medians of the area. Empty if that is
/// not positive and finite.
std::vector<Triangle> draw_by_area(std::span<const glm::dvec3> positions, std::span<const glm::uvec3> triangles) {
    std::vector<double> areas;
    areas.reserve(triangles.size());
    double total = 0;
    for (const glm::uvec3& t : triangles) {
        areas.push_back(Triangle(positions, t).area());
        total += areas.back();
    }
    std::vector<Triangle> drawn;
    if (!(total > 0.0) || !std::isfinite(total)) return drawn;
    const double step = total / static_cast<double>(draws);
    double before = 0;
    for (std::size_t i = 0; i < areas.size(); ++i) {
        before += areas[i];
        while ((static_cast<double>(drawn.size()) + 0.5) * step < before) drawn.emplace_back(positions, triangles[i]);
    }
    return drawn;
}

std::vector<Triangle> draw_by_count(std::span<const glm::dvec3> positions, std::span<const glm::uvec3> triangles) {
    const std::size_t stride = 1 + triangles.size() / draws;
    std::vector<Triangle> drawn;
    for (std::size_t i = 0; i < triangles.size(); i += stride) drawn.emplace_back(positions, triangles[i]);
    return drawn;
}

Middle middle_of(const std::vector<Triangle>& drawn) {
    Middle middle;
    std::vector<double> values(drawn.size());
    for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < drawn.size(); ++i) values[i] = center_of(drawn[i])[axis];
        middle.center[axis] = median(values);
    }
    for (std::size_t i = 0; i < drawn.size(); ++i) values[i] = drawn[i].reach(middle.center);
    middle.size = 2.0 * median(values);
    return middle;
}

/// The share of the triangles whose shadows are lost about `origin`.
double loss_about(const glm::dvec3& origin, const std::vector<Triangle>& drawn) {
    double sum = 0;
    for (const Triangle& triangle : drawn) {
        const double extent = extent_of(triangle);
        if (extent > 0.0) sum += std::min(ray_offset_share * triangle.reach(origin) / (lost_share * extent), 1.0);
    }
    return sum / static_cast<double>(drawn.size());
}

/// The origin, and how large the scene is about it.
Middle choose_origin(std::span<const glm::dvec3> positions, std::span<const glm::uvec3> triangles) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    Middle best{glm::dvec3(0.0), infinite};
    const std::vector<Triangle> by_area = draw_by_area(positions, triangles);
    if (by_area.empty()) return best;
    const std::vector<Triangle> by_count = draw_by_count(positions, triangles);
    const auto loss = [&](const glm::dvec3& origin) {
        return loss_about(origin, by_area) + loss_about(origin, by_count);
    };
    // Only what gains much is moved.
    double least_loss = 0.5 * loss(best.center);
    for (const std::vector<Triangle>* drawn : {&by_area, &by_count}) {
        const Middle middle = middle_of(*drawn);
        if (drawn == &by_area) best.size = middle.size;
        if (!middle.is_far()) continue;
        const double here = loss(middle.origin());
        if (!(here < least_loss)) continue;
        least_loss = here;
        best = {middle.origin(), middle.size};
    }
    return best;
}

void note_coarse_coordinates(Scene& scene, std::span<const glm::dvec3> positions, double size) {
    std::size_t coarse = 0;
    bool is_stray = false;
    double largest_offset = 0.0;
    for (const glm::uvec3& t : scene.triangles) {
        const Triangle triangle(positions, t);
        const double extent = extent_of(triangle);
        const double reach = triangle.reach(scene.origin);
        const double offset = ray_offset_share * reach;
        if (extent > 0.0 && offset > coarse_share * extent) {
            ++coarse;
            largest_offset = std::max(largest_offset, offset);
            is_stray = is_stray || reach > stray * size;
        }
    }
    const bool are_many = static_cast<double>(coarse) > many * static_cast<double>(scene.triangles.size());
    if (coarse == 0 || !(are_many || is_stray)) return;
    std::ostringstream why;
    why << "so far from the scene's middle a float's step is " << largest_offset / ray_offset_share * 0x1p-23
        << ", and rays leave a surface by " << largest_offset << "; split the scene";
    leave_out(scene.left_out, "the shape and the shadows of " + std::to_string(coarse) + " small triangles", why.str());
}

}  // namespace

void set_positions(Scene& scene, std::span<const glm::dvec3> positions) {
    const Middle chosen = choose_origin(positions, scene.triangles);
    scene.origin = chosen.center;
    scene.positions.clear();
    scene.positions.reserve(positions.size());
    for (const glm::dvec3& p : positions) scene.positions.emplace_back(p - scene.origin);
    note_coarse_coordinates(scene, positions, chosen.size);
}

}  // namespace render
