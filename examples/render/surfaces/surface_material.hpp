#pragma once

#include <optional>
#include <variant>

#include <lightcuts/material/above_horizon.hpp>
#include <lightcuts/material/ggx.hpp>
#include <lightcuts/material/lambert.hpp>
#include <lightcuts/material/phase_function.hpp>
#include <lightcuts/material/phong.hpp>

#include "surfaces/surface.hpp"

namespace render {

/// What a surface point does with light: Lambert's lobe and at most one glossy one above both of its normals, and
/// Lambert's for what comes through from below both; a point of fog, by a phase function. Models the library's
/// CompositeMaterial, so that bounds are formed of the parts, and TwoSidedMaterial.
class SurfaceMaterial {
public:
    explicit SurfaceMaterial(const SurfacePoint& p)
        : geometric_normal_(p.geometric_normal), lambert_{p.shading_normal, p.diffuse}, transmitted_(p.transmitted),
          is_thin_(p.transmitted != glm::vec3(0.0f)) {
        if (p.model == SurfacePoint::Model::volume) {
            gloss_.emplace<lightcuts::HenyeyGreenstein<>>(p.to_viewer, glm::vec3(1.0f), p.shininess);
        }
        if (p.specular == glm::vec3(0.0f) && p.model != SurfacePoint::Model::microfacet) return;
        if (p.model == SurfacePoint::Model::phong) {
            gloss_.emplace<lightcuts::ModifiedPhong<>>(p.shading_normal, p.to_viewer, p.specular, p.shininess);
        } else if (p.model == SurfacePoint::Model::microfacet) {
            gloss_.emplace<lightcuts::Ggx<>>(p.shading_normal, p.to_viewer, p.specular, p.shininess, p.grazing);
        }
    }

    glm::vec3 evaluate(const glm::vec3& to_light) const {
        glm::vec3 sum(0.0f);
        for_each_component([&](const auto& part) { sum += part.evaluate(to_light); });
        return sum;
    }

    void evaluate_many(const lightcuts::LaneVectors& to_lights, int count,
                       lightcuts::LaneSpectra<glm::vec3>& values) const {
        values.fill(glm::vec3(0.0f));
        for_each_component([&](const auto& part) { lightcuts::add_lanes(part, to_lights, count, values); });
    }

    glm::vec3 upper_bound(const lightcuts::OffsetBox& offsets) const {
        glm::vec3 sum(0.0f);
        for_each_component([&](const auto& part) { sum += part.upper_bound(offsets); });
        return sum;
    }

    template <class F>
    void for_each_component(F&& f) const {
        using lightcuts::AboveHorizon;
        if (lambert_.albedo != glm::vec3(0.0f)) {
            f(AboveHorizon<const lightcuts::Lambert<>&>{lambert_, geometric_normal_});
        }
        // Most surfaces are diffuse, and are asked but this.
        if (gloss_.index() != 0) for_gloss(f);
        if (is_thin_) [[unlikely]] {
            f(AboveHorizon{lightcuts::Lambert{-lambert_.normal, transmitted_}, -geometric_normal_});
        }
    }

    bool is_behind(const glm::vec3& to_light) const {
        return is_thin_ && glm::dot(glm::dvec3(geometric_normal_), glm::dvec3(to_light)) < 0.0;
    }

    /// See lightcuts::MaterialWithHorizon.
    std::optional<glm::vec3> horizon() const {
        const bool has_one = !is_thin_ && !std::holds_alternative<lightcuts::HenyeyGreenstein<>>(gloss_);
        return has_one ? std::optional(geometric_normal_) : std::nullopt;
    }

private:
    template <class F>
    void for_gloss(F& f) const {
        using lightcuts::AboveHorizon;
        if (const auto* phong = std::get_if<lightcuts::ModifiedPhong<>>(&gloss_)) {
            f(AboveHorizon<const lightcuts::ModifiedPhong<>&>{*phong, geometric_normal_});
        } else if (const auto* ggx = std::get_if<lightcuts::Ggx<>>(&gloss_)) {
            f(AboveHorizon<const lightcuts::Ggx<>&>{*ggx, geometric_normal_});
        } else if (const auto* phase = std::get_if<lightcuts::HenyeyGreenstein<>>(&gloss_)) {
            f(*phase);
        }
    }

    glm::vec3 geometric_normal_;
    lightcuts::Lambert<> lambert_;
    glm::vec3 transmitted_;
    bool is_thin_;
    std::variant<std::monostate, lightcuts::ModifiedPhong<>, lightcuts::Ggx<>, lightcuts::HenyeyGreenstein<>> gloss_;
};

}  // namespace render
