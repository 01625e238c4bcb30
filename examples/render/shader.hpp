#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "options.hpp"
#include "rays/ray_scene.hpp"
#include "scene.hpp"
#include "surfaces/surface.hpp"

namespace render {

/// The light that one surface point reflects to its viewer, and what it cost.
struct Shading {
    glm::vec3 radiance{0.0f};
    glm::vec3 error_bound{0.0f};  ///< absolute radiance; may be infinite
    /// Radiance that no virtual light exceeded; infinite if none was clamped.
    glm::vec3 clamp_threshold{std::numeric_limits<float>::infinity()};
    std::uint32_t cut_size = 0;
    std::uint32_t shadow_rays = 0;    ///< queries answered by the visibility oracle
    std::uint32_t hidden = 0;         ///< clusters on the cut that were proved to be hidden
    bool at_limit = false;            ///< the cut ended at its largest size, not at the error ratio
    std::uint32_t gather_points = 1;  ///< that were summed up
    double pairs = 0;                 ///< of gather points and lights, of methods that sum up pairs
    /// Mean number of instants of the clusters of gather points on the cut, where `options.aovs` asks for it.
    float instants = 1.0f;
    glm::vec3 expected_error{0.0f};  ///< where the error is expected to be below, of methods that have learned
};

/// What it took to learn what is visible.
struct LearningCost {
    std::size_t pilots = 0;
    std::uint64_t shadow_rays = 0;
};

/// How a method uses proofs that clusters are hidden.
struct ProofUse {
    bool used = false;
    /// Steps with proofs over those without, of the pilot's points; nothing if there was no pilot.
    std::optional<double> pilot_ratio = {};
};

/// A method of summing many lights. threads: `shade` may run at once with a scratch for each thread.
class Shader {
public:
    /// Memory that a thread keeps between calls.
    class Scratch {
    public:
        virtual ~Scratch() = default;
    };

    virtual ~Shader() = default;

    virtual std::unique_ptr<Scratch> make_scratch() const = 0;

    /// Fills `out[i]` for `points[i]`. The same points give the same results, whatever was shaded before. Once
    /// `interrupted()`, the rest is given up.
    /// pre: points.size() == out.size(); `scratch` was made by this shader.
    virtual void shade(std::span<const SurfacePoint> points, std::span<Shading> out, Scratch& scratch) const = 0;

    /// True if this method sums up all points of a pixel at once, by `shade_pixel`.
    virtual bool shades_pixels() const { return false; }

    /// The sum of what `points`, all of one pixel, send to the eye: each times its weight and `share`. pre:
    /// shades_pixels(); `scratch` was made by this shader.
    virtual Shading shade_pixel(std::span<const SurfacePoint> points, float share, Scratch& scratch) const {
        static_cast<void>(points);
        static_cast<void>(share);
        static_cast<void>(scratch);
        return {};
    }

    /// Learns from some points of the picture what is visible to others near them; methods that do not do nothing. By
    /// the threads of the calling task arena. pre: `adapt` was called, and nothing is being shaded.
    virtual LearningCost learn(std::span<const SurfacePoint> pilots) {
        static_cast<void>(pilots);
        return {};
    }

    /// True if the method wants to `try_out` points before the picture.
    virtual bool wants_pilot() const { return false; }

    /// Takes some points of the picture, in blocks of neighbors, to find out what pays. pre: wants_pilot(); nothing
    /// else runs
    virtual void try_out(std::span<const std::vector<SurfacePoint>> blocks) { static_cast<void>(blocks); }

    virtual ProofUse proof_use() const { return {}; }

    /// Takes the radiance to which the viewer's eye is adapted; methods that do not use it do nothing.
    virtual void adapt(float radiance) { static_cast<void>(radiance); }
};

/// The shader of `options.method` for the lights of `scene`. Trees are built here. Both references are kept.
std::unique_ptr<Shader> make_shader(const Scene& scene, const RayScene& rays, const Options& options);

}  // namespace render
