#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec3.hpp>
#include <render/scene.hpp>
#include <render/surfaces/surface_lobes.hpp>

#include "bounce_light.hpp"
#include "bounce_shader.hpp"
#include "illumination.hpp"
#include "material_change.hpp"
#include "relight_file.hpp"
#include "relit_shader.hpp"
#include "seen_points.hpp"
#include "site.hpp"

namespace relight {

/// The light of a map that the scene's surfaces reflect once: at the patches of a file it is computed as at points of a
/// picture, of the sites' cuts of the sky.
class Bounce {
public:
    /// As `BounceShader`, of `scene` with the patches' diffuse parts, see `points_of`.
    Bounce(const RelightFile& file, const render::Scene& scene, const Sites& sites, const SeenPoints& seen,
           render::Shade shade);

    /// What patches reflect is changed likewise.
    void change_materials(const MaterialChange& change) { change_all(own_lobes_, change, points_.points); }

    /// Adds it to `radiance`, by point of the picture.
    void add(const Illumination& sky, const BounceOptions& options, const RelitOptions& lobes,
             std::span<glm::vec3> radiance);

    /// By patch, the radiance that it reflected last.
    std::span<const glm::vec3> patch_radiance() const { return radiance_; }
    /// The patches, as points.
    const SeenPoints& points() const { return points_; }
    double mean_cut_size() const { return shader_.mean_cut_size(); }
    std::size_t light_cut_size() const { return light_.cut().size(); }

private:
    SeenPoints points_;
    std::vector<render::SurfaceLobes> own_lobes_;  ///< by patch
    RelitShader reflection_;
    BounceLight light_;
    BounceShader shader_;
    std::vector<glm::vec3> radiance_;
};

}  // namespace relight
