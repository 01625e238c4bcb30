#include "io/world_origin.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>

#include <glm/common.hpp>

namespace render {
namespace {

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// Scenes that are farther away than so many times their size are moved.
constexpr double far = 8.0;
/// Where the step of a float is more than this share of a triangle, its shape is lost.
constexpr double coarse_share = 1e-2;
/// Of so many of a scene's triangles a person should know.
constexpr double many = 0.01;

void note_coarse_coordinates(Scene& scene, std::span<const glm::dvec3> positions) {
    std::size_t coarse = 0;
    double largest_step = 0.0;
    for (const glm::uvec3& t : scene.triangles) {
        const glm::dvec3& a = positions[t.x];
        const glm::dvec3& b = positions[t.y];
        const glm::dvec3& c = positions[t.z];
        const double size = largest(glm::max(a, glm::max(b, c)) - glm::min(a, glm::min(b, c)));
        const double step = largest(a - scene.origin) * 0x1p-23;
        if (size > 0.0 && step > coarse_share * size) {
            ++coarse;
            largest_step = std::max(largest_step, step);
        }
    }
    if (static_cast<double>(coarse) <= many * static_cast<double>(scene.triangles.size())) return;
    std::ostringstream why;
    why << "so far from the scene's middle a float's step is " << largest_step << "; split the scene";
    leave_out(scene.left_out, "the shape of " + std::to_string(coarse) + " small triangles", why.str());
}

}  // namespace

glm::dvec3 world_origin(std::span<const glm::dvec3> positions) {
    if (positions.empty()) return glm::dvec3(0.0);
    glm::dvec3 low = positions.front();
    glm::dvec3 high = low;
    for (const glm::dvec3& p : positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::dvec3 centre = 0.5 * low + 0.5 * high;
    const double size = largest(high - low);
    // Also if something is not finite.
    if (!(size > 0.0) || !(largest(centre) > far * size)) return glm::dvec3(0.0);
    const double step = std::exp2(std::floor(std::log2(size)));
    return step * glm::round(centre / step);
}

void set_positions(Scene& scene, std::span<const glm::dvec3> positions) {
    scene.origin = world_origin(positions);
    scene.positions.clear();
    scene.positions.reserve(positions.size());
    for (const glm::dvec3& p : positions) scene.positions.emplace_back(p - scene.origin);
    note_coarse_coordinates(scene, positions);
}

}  // namespace render
