#pragma once

#include <algorithm>
#include <cmath>

#include <lightcuts/core/box.hpp>
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
        : OpaqueOracle(scene, rays), hidden_(mesh, FirstTriangle(rays)), group_(group) {
        // Shadow rays end off the surfaces that lights lie on, and at the spheres that they lie in.
        largest_radius_ = static_cast<float>(1e-5 * mesh.reach());
        for (const auto& sphere : scene.spheres) largest_radius_ = std::max(largest_radius_, sphere.radius);
    }

    template <class M>
    bool hides(const lightcuts::Receiver<M>& receiver, const lightcuts::Box& lights) const {
        return prove(receiver, lightcuts::Box{lights.lo - largest_radius_, lights.hi + largest_radius_});
    }
    template <class M>
    bool hides(const lightcuts::Receiver<M>& receiver, const lightcuts::DirectionBox& lights) const {
        return prove(receiver, lights);
    }

private:
    template <class M, class Lights>
    bool prove(const lightcuts::Receiver<M>& receiver, const Lights& lights) const {
        return group_ ? group_->hides(hidden_, lights) : hidden_.hides(receiver, lights);
    }

    lightcuts::HiddenLights<FirstTriangle> hidden_;
    lightcuts::SharedProofs* group_;
    float largest_radius_ = 0.0f;
};

}  // namespace render
