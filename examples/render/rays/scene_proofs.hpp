#pragma once

#include <algorithm>
#include <cstddef>

#include <glm/geometric.hpp>
#include <lightcuts/visibility/hidden_lights.hpp>
#include <lightcuts/visibility/occluder_mesh.hpp>

#include "rays/opaque_mesh.hpp"
#include "rays/ray_scene.hpp"
#include "scene.hpp"

namespace render {

/// The triangle of a scene that a segment or a ray meets first, for proofs that lights are hidden.
class FirstTriangle {
public:
    explicit FirstTriangle(const RayScene& rays) : rays_(rays) {}

    lightcuts::OccluderMesh::Index operator()(const lightcuts::VisibilityQuery& query) const {
        const glm::dvec3 way = query.distant ? glm::dvec3(query.to) : glm::dvec3(query.to) - glm::dvec3(query.from);
        const double length = glm::length(way);
        if (!(length > 0.0)) return lightcuts::OccluderMesh::no_triangle;
        const auto hit = rays_.nearest(query.from, glm::vec3(way / length));
        const bool is_between = hit && (query.distant || static_cast<double>(hit->distance) < length);
        return is_between ? hit->triangle : lightcuts::OccluderMesh::no_triangle;
    }

private:
    const RayScene& rays_;
};

/// Proofs that what is opaque and still in a scene hides lights, whatever else light passes through or moves.
class SceneProofs {
public:
    using HiddenLights = lightcuts::HiddenLights<FirstTriangle>;

    /// Both are referred to.
    SceneProofs(const Scene& scene, const RayScene& rays)
        : mesh_(opaque_mesh(scene)),
          hidden_(mesh_, FirstTriangle(rays), {.end_distance = end_distance(scene, mesh_.reach())}) {}
    SceneProofs(const SceneProofs&) = delete;
    SceneProofs& operator=(const SceneProofs&) = delete;

    const lightcuts::OccluderMesh& mesh() const { return mesh_; }
    const HiddenLights& hidden() const { return hidden_; }

private:
    /// Shadow rays end off the surfaces that lights lie on, and where they enter the spheres that lights lie in.
    static double end_distance(const Scene& scene, double reach) {
        double largest = 1e-5 * reach;
        for (const auto& sphere : scene.spheres) largest = std::max(largest, 2.0 * static_cast<double>(sphere.radius));
        for (const auto& sphere : scene.at_instants.spheres) {
            largest = std::max(largest, 2.0 * static_cast<double>(sphere.radius));
        }
        return largest;
    }

    lightcuts::OccluderMesh mesh_;
    HiddenLights hidden_;
};

}  // namespace render
