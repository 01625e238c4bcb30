#include "surfaces/gather_lobes.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <lightcuts/material/above_horizon.hpp>

namespace render {

namespace {

constexpr glm::vec3 black(0.0f);

bool has_gloss(const SurfacePoint& p) {
    return p.model != SurfacePoint::Model::lambert && p.model != SurfacePoint::Model::volume &&
           (p.specular != black || p.model == SurfacePoint::Model::microfacet);
}

std::variant<lightcuts::ModifiedPhong<>, lightcuts::Ggx<>> lobe_of(const SurfacePoint& p) {
    if (p.model == SurfacePoint::Model::phong) {
        return lightcuts::ModifiedPhong<>(p.shading_normal, p.to_viewer, p.specular, p.shininess);
    }
    return lightcuts::Ggx<>(p.shading_normal, p.to_viewer, p.specular, p.shininess, p.grazing);
}

}  // namespace

glm::vec3 DiffuseLobe::evaluate(const glm::vec3& to_light) const {
    return lightcuts::AboveHorizon{lightcuts::Lambert{normal, glm::vec3(1.0f)}, geometric_normal}.evaluate(to_light);
}

lightcuts::CosineLobe<glm::vec3> DiffuseLobe::cosine_lobe() const {
    return lightcuts::Lambert{normal, glm::vec3(1.0f)}.cosine_lobe();
}

GlossyLobe::GlossyLobe(const SurfacePoint& p) : geometric_normal_(p.geometric_normal), lobe_(lobe_of(p)) {}

glm::vec3 GlossyLobe::evaluate(const glm::vec3& to_light) const {
    return std::visit(
        [&]<class M>(const M& lobe) {
            return lightcuts::AboveHorizon<const M&>{lobe, geometric_normal_}.evaluate(to_light);
        },
        lobe_);
}

glm::vec3 GlossyLobe::upper_bound(const lightcuts::OffsetBox& offsets) const {
    return std::visit(
        [&]<class M>(const M& lobe) {
            return lightcuts::AboveHorizon<const M&>{lobe, geometric_normal_}.upper_bound(offsets);
        },
        lobe_);
}

glm::vec3 GlossyLobe::main_direction() const {
    return std::visit([](const auto& lobe) { return lobe.main_direction(); }, lobe_);
}

GlossyEnvelope GlossyLobe::envelope() const {
    if (const auto* phong = std::get_if<lightcuts::ModifiedPhong<>>(&lobe_)) return {phong->envelope(), {}};
    return {{}, std::get<lightcuts::Ggx<>>(lobe_).envelope()};
}

glm::vec3 GlossyEnvelope::upper_bound(const lightcuts::OffsetBox& offsets) const {
    return glm::max(phong.upper_bound(offsets), microfacet.upper_bound(offsets));
}

void GatherPoints::clear() {
    diffuse.clear();
    glossy.clear();
    fog.clear();
    shadow_offset = 0.0f;
}

void GatherPoints::add(const SurfacePoint& p, float share, std::uint32_t name) {
    const glm::vec3 weight = p.weight * share;
    shadow_offset = std::max(shadow_offset, glm::length(p.ray_origin - p.position));
    if (p.model == SurfacePoint::Model::volume) {
        const lightcuts::HenyeyGreenstein<> phase(p.to_viewer, glm::vec3(1.0f), p.shininess);
        fog.push_back({{{p.position, phase, p.ray_origin, name}, weight}, p.instant});
        return;
    }
    if (p.diffuse != black) {
        diffuse.push_back(
            {{{p.position, {p.shading_normal, p.geometric_normal}, p.ray_origin, name}, weight * p.diffuse},
             p.instant});
    }
    if (p.transmitted != black) {
        const glm::vec3 behind = p.position + (p.position - p.ray_origin);
        diffuse.push_back(
            {{{p.position, {-p.shading_normal, -p.geometric_normal}, behind, name}, weight * p.transmitted},
             p.instant});
    }
    if (has_gloss(p)) glossy.push_back({{{p.position, GlossyLobe(p), p.ray_origin, name}, weight}, p.instant});
}

}  // namespace render
