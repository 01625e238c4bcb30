#pragma once

#include <algorithm>
#include <optional>

#include <lightcuts/core/assertion.hpp>
#include <lightcuts/visibility/hidden_lights.hpp>
#include <lightcuts/visibility/shared_proofs.hpp>

#include "rays/oracle.hpp"
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

/// Opaque surfaces that do not move, with proofs that whole clusters are hidden: from a group of receivers, or from
/// each of its own.
class ProvingOracle : public OpaqueOracle {
public:
    /// `mesh`: opaque_mesh(scene). All are referred to.
    ProvingOracle(const Scene& scene, const RayScene& rays, const lightcuts::OccluderMesh& mesh,
                  lightcuts::SharedProofs* group = nullptr)
        : OpaqueOracle(scene, rays), hidden_(mesh, FirstTriangle(rays), {.end_distance = end_distance(scene, mesh)}),
          group_(group) {
        LIGHTCUTS_ASSERT(scene.is_still());
    }

    /// `lights`: a lightcuts::Box or DirectionBox.
    template <class M, class Lights>
    bool hides(const lightcuts::Receiver<M>& receiver, const Lights& lights) const {
        // Asked from behind of what reflects nothing from there.
        const std::optional<glm::vec3> normal = receiver.material.horizon();
        if (normal && glm::dot(*normal, receiver.shadow_origin - receiver.position) < 0.0f) return true;
        return group_ ? group_->hides(hidden_, lightcuts::box_of(receiver), lights) : hidden_.hides(receiver, lights);
    }

private:
    /// Shadow rays end off the surfaces that lights lie on, and where they enter the spheres that lights lie in.
    static double end_distance(const Scene& scene, const lightcuts::OccluderMesh& mesh) {
        double largest = 1e-5 * mesh.reach();
        for (const auto& sphere : scene.spheres) largest = std::max(largest, 2.0 * static_cast<double>(sphere.radius));
        return largest;
    }

    lightcuts::HiddenLights<FirstTriangle> hidden_;
    lightcuts::SharedProofs* group_;
};

}  // namespace render
