#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <glm/ext/vector_int3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <lightcuts/core/random.hpp>

#include "scene.hpp"

namespace render {

/// Random numbers for procedural scenes: the n-th call hashes (seed, n), on every machine alike. Two calls among the
/// arguments of one function come in an order that compilers choose: give the first a name.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : seed_(seed) {}

    float uniform(float low, float high) {
        return low + (high - low) * static_cast<float>(lightcuts::uniform01(lightcuts::hash_keys(seed_, calls_++)));
    }
    /// pre: count > 0.
    std::size_t pick(std::size_t count) {
        return static_cast<std::size_t>(lightcuts::hash_keys(seed_, calls_++) % count);
    }

private:
    std::uint64_t seed_;
    std::uint64_t calls_ = 0;
};

/// A smooth curve through `points` (Catmull and Rom), `steps` to an interval; the ends stay as they are.
/// Radii stay positive.
std::vector<glm::vec2> smooth_profile(std::span<const glm::vec2> points, int steps);

/// The inside of a closed shape, so that lights can be kept out of it.
struct Solid {
    glm::mat4 to_local{1.0f};
    glm::vec3 low{0.0f};  ///< the box, in local coordinates
    glm::vec3 high{0.0f};
    std::vector<glm::vec2> profile;  ///< of a body of revolution about y, (radius, height); empty: the box itself
    glm::vec3 world_low{0.0f};
    glm::vec3 world_high{0.0f};

    bool contains(const glm::vec3& p) const;
};

/// Planes across each axis, rising, that cut space into the cells of `Modeller::blocks`.
struct BlockGrid {
    std::array<std::vector<float>, 3> planes;

    int cells(int axis) const { return static_cast<int>(planes[static_cast<std::size_t>(axis)].size()) - 1; }
    /// The middle of a cell.
    glm::vec3 middle(const glm::ivec3& cell) const;
};

/// Builds a scene's mesh from simple shapes, each with the current `place` and `material`. Faces look outwards.
struct Modeller {
    explicit Modeller(Scene& to) : scene(to) {}

    Scene& scene;
    glm::mat4 place{1.0f};
    std::uint32_t material = 0;
    std::vector<Solid> solids;

    /// Adds a glTF-style material; `metallic` 0 or 1. Returns its index.
    /// Not metallic and of roughness 0.35 or more: purely diffuse.
    std::uint32_t paint(std::string name, const glm::vec3& color, float roughness, float metallic = 0.0f);

    /// Moves the origin to `p`, turned by `degrees` about y.
    void stand(const glm::vec3& p, float degrees = 0.0f);

    /// A flat triangle, seen counter-clockwise.
    void facet(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

    /// A flat grid from `corner` along the sides `u` and `v`, looking along u x v.
    void quad(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v, int cells_u = 1, int cells_v = 1);

    /// An axis-aligned box.
    void box(const glm::vec3& low, const glm::vec3& high);

    /// The surface of the solid cells of `grid`, as one mesh that shares corners and has no gaps. `solid(cell)` says
    /// which are; `paint_of(cell, axis, side)` is the material of the face of a solid cell to the side -1 or +1 along
    /// an axis. Cells are counted from 0 along x, y and z.
    void blocks(const BlockGrid& grid, const std::function<bool(const glm::ivec3&)>& solid,
                const std::function<std::uint32_t(const glm::ivec3&, int, int)>& paint_of);

    /// Turns a profile of (radius, height) about the y axis. The profile goes upwards along the outside; a point
    /// given twice is a sharp edge. Closed, if its ends have radius 0.
    void lathe(std::span<const glm::vec2> profile, int segments);

    /// A smooth surface around the y axis through rings of `around` points, counter-clockwise seen from above, the
    /// lowest ring first. It is open at both ends.
    void sleeve(std::span<const glm::vec3> points, int around);

    void sphere(const glm::vec3& center, float radius, int segments);
    void cylinder(const glm::vec3& base, float radius, float height, int segments);

    /// A pipe along `path`; the ends are open unless it is `closed` to a ring.
    void tube(std::span<const glm::vec3> path, float radius, int segments, bool closed);

    /// A bent blade from `root`: `tip` is its far end, `droop` pulls the end down; two triangles a segment, smooth.
    void blade(const glm::vec3& root, const glm::vec3& tip, float width, float droop, int segments);

    /// True iff `p` is neither inside a solid nor within about `margin` of one. cost: linear in the solids.
    bool is_free(const glm::vec3& p, float margin) const;

private:
    std::uint32_t vertex(const glm::vec3& p, const glm::vec3& normal);
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    void add_solid(const glm::vec3& low, const glm::vec3& high, std::span<const glm::vec2> profile);
};

}  // namespace render
