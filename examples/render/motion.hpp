#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "scene.hpp"
#include "shutter.hpp"
#include "triangle.hpp"

namespace render {

/// Some vertices at one time, in a scene's coordinates. Normals and tangents may be empty.
struct VertexFrame {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents;
};

/// Vertices at `time`, 0 as the shutter opens to 1 as it closes.
using VertexPath = std::function<VertexFrame(double time)>;

/// Lets `count` vertices from `first` on move along `path`, in as many straight steps, a power of two up to 128, as
/// bring every vertex within 1/4000 of their extent of the path, and at least `least_steps`: give so many that the path
/// does not turn back and forth within one. Of more than 2^18 vertices there are fewer steps, so that a part takes no
/// more than about a gigabyte; where these are fewer than `least_steps`, `scene.left_out` says so. Nothing is added if
/// the vertices do not move. pre: called in ascending order of `first`, after the scene has all vertices and their
/// attributes. cost: up to twice as many frames as steps.
void add_motion(Scene& scene, std::uint32_t first, std::uint32_t count, std::uint32_t least_steps,
                const VertexPath& path);

/// Puts the parts that `scene.rigid_motions` names where they are as the shutter opens, and in motion while it is open;
/// their spherical lights are then one for each instant.
void apply_rigid_motions(Scene& scene, const Shutter& shutter);

/// Gives the scene its instants if anything of it moves.
void set_instants(Scene& scene, const Shutter& shutter);

/// What moves vertex `vertex`; null if nothing does. cost: logarithmic in the moving parts.
const MovingVertices* motion_of(const Scene& scene, std::uint32_t vertex);

inline bool moves(const Scene& scene, std::uint32_t triangle) {
    return !scene.moving.empty() && motion_of(scene, scene.triangles[triangle].x) != nullptr;
}

/// A triangle at `time`.
Triangle triangle_at(const Scene& scene, std::uint32_t triangle, float time);

/// What the corners of a triangle have at `time`. pre: the scene has normals or tangents, respectively.
std::array<glm::vec3, 3> normals_at(const Scene& scene, std::uint32_t triangle, float time);
std::array<glm::vec4, 3> tangents_at(const Scene& scene, std::uint32_t triangle, float time);

/// The time of a receiver of this name, in which its instant is: see `name_with_instant`.
inline float time_of_receiver(const Scene& scene, std::uint32_t name) {
    return scene.is_still() ? 0.0f : scene.instants[instant_in_name(name, scene.instants.size())];
}

}  // namespace render
