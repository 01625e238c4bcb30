#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <utility>

#include <glm/vec3.hpp>

#include "../core/box.hpp"
#include "../core/cone.hpp"
#include "../material/material.hpp"
#include "../shading/receiver.hpp"
#include "flood.hpp"
#include "occluder_mesh.hpp"
#include "oracle.hpp"
#include "query.hpp"

namespace lightcuts {

/// The user's ray tracer, as proofs ask it: the number in the OccluderMesh of the first triangle that a segment from
/// `query.from` to `query.to` meets, or that a ray in the direction `query.to` meets if the query is `distant`;
/// OccluderMesh::no_triangle if it meets none. It may also say that where a triangle of no mesh is met first. A wrong
/// answer can make a proof fail, never go wrong.
template <class H>
concept FirstHit = requires(const H& hit, const VisibilityQuery& query) {
    { hit(query) } -> std::convertible_to<OccluderMesh::Index>;
};

/// What proofs took.
struct ProofSteps {
    std::uint64_t rays = 0;       ///< asked of a FirstHit
    std::uint64_t triangles = 0;  ///< met by walks

    /// In shadow rays, about, where these are traced in streams: the same on every machine and in every run.
    double in_shadow_rays() const { return 8.0 * static_cast<double>(rays) + 0.3 * static_cast<double>(triangles); }
};

/// A receiver as a box of one: its shadow_origin, and the horizon that its material says it has, see
/// MaterialWithHorizon; Lambert's is known.
template <class M>
ReceiverBox box_of(const Receiver<M>& receiver) {
    ReceiverBox box{box_of(receiver.shadow_origin)};
    std::optional<glm::vec3> normal;
    if constexpr (MaterialWithHorizon<std::remove_cvref_t<M>>) {
        normal = receiver.material.horizon();
    } else if constexpr (CosineLobeMaterial<std::remove_cvref_t<M>>) {
        const auto lobe = receiver.material.cosine_lobe();
        const Cone normals = merge(Cone{}, lobe.normal);
        if (is_single(normals)) normal = normals.axis;
    }
    if (normal) box.horizon = Horizon{*normal, box_of(receiver.position)};
    return box;
}

/// Says of boxes of lights that all of them are hidden from a receiver, if `Flood` proves it: what a HidingOracle
/// answers from. A view of the mesh.
template <FirstHit H>
class HiddenLights {
public:
    HiddenLights(const OccluderMesh& mesh, H first_hit, const FloodOptions& options = {})
        : mesh_(mesh), flood_(mesh, options), first_hit_(std::move(first_hit)) {}
    /// It would refer to what is gone.
    HiddenLights(const OccluderMesh&&, H, const FloodOptions& = {}) = delete;

    /// True only if no shadow ray from the receivers reaches a light of the box; `lights`: a Box of positions or a
    /// DirectionBox. Asks for the triangle between the middles of the boxes and, if nothing can be proved from it, for
    /// the ones behind it. Adds to `steps`, if there are any, what it took.
    /// threads: as `H`. cost: one to three rays, and Flood's
    template <class Lights>
    bool hides(const ReceiverBox& receivers, const Lights& lights, ProofSteps* steps = nullptr) const {
        if (mesh_.empty() || Flood::is_empty_problem(receivers, lights)) return false;
        const Flood::Segment segment = Flood::start_segment(receivers, lights);
        if (!segment.exists) return false;
        VisibilityQuery query{glm::vec3(segment.from), 0, glm::vec3(segment.to), 0, 0, segment.distant};
        std::optional<Flood::Passage> passage;
        for (int tries = 0; tries < 3; ++tries) {
            if (steps) ++steps->rays;
            const OccluderMesh::Index triangle = first_hit_(query);
            if (triangle >= mesh_.size()) return false;
            if (tries == 0) passage = flood_.prepare(receivers, lights);
            if (!passage) return false;
            const Flood::Walk walk = flood_.walk(*passage, triangle);
            if (steps) steps->triangles += walk.triangles;
            if (walk.hides) return true;
            const std::optional<glm::vec3> behind = flood_.place_behind(segment, triangle);
            if (!behind) return false;
            query.from = *behind;
        }
        return false;
    }

    /// The same of a receiver, whose rays start at its shadow_origin: what the `hides` of a HidingOracle returns.
    template <class M, class Lights>
    bool hides(const Receiver<M>& receiver, const Lights& lights) const {
        return hides(box_of(receiver), lights);
    }

private:
    const OccluderMesh& mesh_;
    Flood flood_;
    H first_hit_;
};

}  // namespace lightcuts
