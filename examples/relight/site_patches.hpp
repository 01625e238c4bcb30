#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <render/rays/ray_scene.hpp>
#include <render/rays/sky_rays.hpp>

#include "patches.hpp"
#include "site.hpp"
#include "site_sky.hpp"

namespace relight {

/// Patches as sites see them, one after another. threads: one object a thread.
class SitePatches {
public:
    /// `ends`: see `ray_ends`. All references are kept.
    SitePatches(const Patches& patches, std::span<const glm::vec3> ends, const render::RayScene& rays, Sides sides)
        : patches_(patches), ends_(ends), rays_(rays), sides_(sides), shares_(patches.size()), asked_(patches.size()) {}

    /// Traces a ray to each patch that faces `site`: above the horizon they start on the front, below on the back, if
    /// that is asked for.
    void look(const Site& site);

    /// By patch, its solid angle times the share of it that is visible. 0 where it was not asked for.
    std::span<const float> shares() const { return shares_; }
    /// By patch, whether a ray was traced.
    bool was_asked(std::size_t patch) const { return asked_[patch] != 0; }
    std::size_t asked_count() const { return order_.size(); }
    /// Seconds that all rays of this object took.
    double ray_seconds() const { return ray_seconds_; }

private:
    const Patches& patches_;
    std::span<const glm::vec3> ends_;
    const render::RayScene& rays_;
    render::SkyRays queries_;
    Sides sides_;
    double ray_seconds_ = 0.0;
    std::vector<float> shares_;
    std::vector<std::uint8_t> asked_;
    std::vector<std::uint32_t> order_;  ///< patches that are traced
    std::vector<glm::vec3> traced_;
    std::vector<float> answers_;
};

}  // namespace relight
