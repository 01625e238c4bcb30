#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>
#include <render/scene.hpp>
#include <render/surfaces/surface.hpp>

namespace relight {

/// A place of the mesh from which the sky is looked at: a corner that triangles of about one direction share.
struct Site {
    glm::vec3 front{0.0f};   ///< where rays to the sky start on the side of `normal`, off the surface
    glm::vec3 back{0.0f};    ///< and on the other
    glm::vec3 normal{0.0f};  ///< mean of the triangles', of the side from which their corners run counter-clockwise
    /// A direction whose cosine with `normal` is above this is above one of the triangles at least.
    float horizon = 0.0f;
};

struct Sites {
    std::vector<Site> sites;
    std::vector<glm::uvec3> of_triangle;  ///< by triangle: at its three corners
};

/// The sites of a mesh. Vertices in one place, as along seams of a texture, share theirs. Where triangles at a vertex
/// are at an angle, as along the edges of a box, those of each direction have a site of their own, which lies a little
/// inside of them: at the foot of a wall it looks from the wall.
/// pre: nothing moves.
Sites sites_of(const render::Scene& scene);

/// How much the corners of its triangle weigh at `point`.
inline glm::vec3 corner_weights(const render::SurfacePoint& point) {
    return {1.0f - point.u - point.v, point.u, point.v};
}

/// True if `point` shows the side from which the corners of its triangle run clockwise.
bool shows_back(const Sites& sites, const render::SurfacePoint& point);

}  // namespace relight
