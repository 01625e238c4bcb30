#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>
#include <lightcuts/material/ggx.hpp>
#include <lightcuts/material/lambert.hpp>
#include <lightcuts/material/phase_function.hpp>
#include <lightcuts/material/phong.hpp>
#include <lightcuts/product/gather_point.hpp>

#include "surfaces/surface.hpp"

namespace render {

/// Lambert's lobe of albedo 1 above both normals of a surface.
struct DiffuseLobe {
    glm::vec3 normal{0.0f};  ///< the shading normal
    glm::vec3 geometric_normal{0.0f};

    glm::vec3 evaluate(const glm::vec3& to_light) const;
    lightcuts::CosineLobe<glm::vec3> cosine_lobe() const;
};

/// Dominates several glossy lobes.
struct GlossyEnvelope {
    lightcuts::PhongEnvelope<glm::vec3> phong;
    lightcuts::GgxEnvelope<glm::vec3, lightcuts::HeightCorrelated> microfacet;

    glm::vec3 upper_bound(const lightcuts::OffsetBox& offsets) const;
    /// Dominates what either dominates.
    friend GlossyEnvelope merge(const GlossyEnvelope& a, const GlossyEnvelope& b) {
        return {merge(a.phong, b.phong), merge(a.microfacet, b.microfacet)};
    }
};

/// The glossy lobe of a surface, above both of its normals.
class GlossyLobe {
public:
    /// pre: the point has one: `specular` is not black, or `model` is microfacet.
    explicit GlossyLobe(const SurfacePoint& point);

    glm::vec3 evaluate(const glm::vec3& to_light) const;
    glm::vec3 upper_bound(const lightcuts::OffsetBox& offsets) const;
    GlossyEnvelope envelope() const;
    /// The mirrored view, longer where the lobe is sharper: 1 to 4.
    glm::vec3 main_direction() const;

private:
    glm::vec3 geometric_normal_;
    std::variant<lightcuts::ModifiedPhong<>, lightcuts::Ggx<>> lobe_;
};

using DiffuseGatherPoint = lightcuts::InstantGatherPoint<DiffuseLobe>;
using GlossyGatherPoint = lightcuts::InstantGatherPoint<GlossyLobe>;
using FogGatherPoint = lightcuts::InstantGatherPoint<lightcuts::HenyeyGreenstein<>>;

/// Gather points by the type of their lobes.
struct GatherPoints {
    std::vector<DiffuseGatherPoint> diffuse;
    std::vector<GlossyGatherPoint> glossy;
    std::vector<FogGatherPoint> fog;
    float shadow_offset = 0.0f;  ///< the largest distance of a shadow ray's origin from its point

    void clear();
    /// Adds one for each lobe of `point`, of its weight times `share`. `name`: the receiver's id.
    void add(const SurfacePoint& point, float share, std::uint32_t name);
};

}  // namespace render
