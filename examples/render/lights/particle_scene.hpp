#pragma once

#include <optional>

#include <glm/vec3.hpp>
#include <lightcuts/core/box.hpp>
#include <lightcuts/source/virtual_lights.hpp>

#include "fog.hpp"
#include "rays/ray_scene.hpp"
#include "scene.hpp"
#include "surfaces/surface.hpp"
#include "surfaces/surface_lobes.hpp"

namespace render {

/// A scene as particles meet it: the library's TransmissiveParticleScene. Surfaces do with particles what they do with
/// eye rays. threads: all may be called at once.
class ParticleScene {
public:
    struct Hit {
        glm::vec3 position{0.0f};         ///< off the surface, as shadow rays start
        glm::vec3 position_behind{0.0f};  ///< likewise, on the other side
        glm::vec3 normal{0.0f};           ///< the geometric one: light leaves on one side of a flat piece
        SurfaceGeometry surface;
        SurfaceResponse response;
    };

    /// The scene as the shutter opens. Both must outlive this object.
    ParticleScene(const Scene& scene, const RayScene& rays, Shade shade);

    /// The scene at `time`, 0 as the shutter opens to 1 as it closes.
    ParticleScene at(float time) const {
        ParticleScene other = *this;
        other.time_ = time;
        return other;
    }

    std::optional<Hit> intersect(const glm::vec3& origin, const glm::vec3& direction) const;

    glm::vec3 diffuse_albedo(const Hit& met) const;
    glm::vec3 diffuse_transmittance(const Hit& met) const;

    /// One of the ways on, in proportion to what it carries: holes, panes, mirrors and glass, or a direction drawn from
    /// the sum of both reflecting lobes [Veach 1995, balance heuristic] or from the one behind; GGX's from the visible
    /// normals [Heitz 2018]. Where they carry more than what arrives, all are scaled down to that.
    lightcuts::ScatteredParticle<> scatter(const Hit& met, const glm::vec3& direction, const glm::vec3& u) const;

    /// Of the scene at all times.
    const lightcuts::Box& bounds() const { return bounds_; }

private:
    /// `scatter`, not scaled.
    lightcuts::ScatteredParticle<> draw(const Hit& met, const glm::vec3& direction, const glm::vec3& u) const;

    const Scene& scene_;
    const RayScene& rays_;
    Shade shade_;
    float time_ = 0;
    lightcuts::Box bounds_;
};

/// The same with its fog: the library's ScatteringParticleScene.
class FoggyParticleScene : public ParticleScene {
public:
    FoggyParticleScene(const ParticleScene& surfaces, const Fog& fog)
        : ParticleScene(surfaces), fog_(fog), bounds_(lightcuts::merge(surfaces.bounds(), fog.medium.where())) {}

    FoggyParticleScene at(float time) const { return {ParticleScene::at(time), fog_}; }

    double free_flight(const glm::vec3& origin, const glm::vec3& direction, double u) const;
    lightcuts::MediumScattering<> scattering_at(const glm::vec3&) const {
        return {glm::vec3(fog_.albedo), fog_.anisotropy};
    }

    /// Of the scene at all times and of the fog: what is outside attenuates nothing.
    const lightcuts::Box& bounds() const { return bounds_; }

private:
    Fog fog_;
    lightcuts::Box bounds_;
};

}  // namespace render
