#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "lights/area_samples.hpp"
#include "lights/emission_range.hpp"
#include "lights/pieces.hpp"
#include "scene.hpp"

namespace render {

/// A piece of an emitter seen as a point.
struct EmissionSample {
    AreaSample place;
    glm::vec3 intensity{0.0f};  ///< along the normal, W/sr
};

/// Points that stand for what surfaces emit on their fronts. Where that varies, by texture, opacity or vertex color, a
/// surface is cut into pieces until the integral over it is known: by bounds over each piece, so that no spot is too
/// small to be found, down to a texel of any map.
class EmissionSampler {
public:
    /// For `surfaces` surfaces of `materials` in all: of very many, each is known less exactly. `scene` must outlive
    /// this object. cost: O(texels) of the textures that these emit by.
    EmissionSampler(const Scene& scene, std::span<const std::uint32_t> materials, std::size_t surfaces);

    /// `count` points of equal power (sum of channels) that stand for the emission of `triangles`: dense where radiance
    /// is high, evenly spread where it is constant; each has the intensity of its own part, and all together that of
    /// the whole. Empty iff nothing is emitted. cost: O((T + count) log(T + count)), and where the radiance varies as
    /// many pieces as it takes, at most half a million.
    std::vector<EmissionSample> spread(std::span<const std::uint32_t> triangles, std::size_t count) const;

    /// Area of `triangles` times the sum of channels of the radiance that their fronts emit; to within 5 % where it
    /// varies.
    double power(std::span<const std::uint32_t> triangles) const;

    /// How far the power of what was spread may be off, as a share: the largest standard deviation so far.
    double largest_error() const { return largest_error_; }

    const EmissionRange& range() const { return range_; }

private:
    /// A piece and what is known of it.
    struct Part : Piece {
        glm::dvec3 power{0.0};      ///< area x mean radiance
        glm::dvec3 range{0.0};      ///< area x the range of radiance
        glm::dvec3 deviation{0.0};  ///< area x the standard deviation of radiance, at most
    };
    /// All that emits of a surface.
    struct Parts {
        std::vector<Part> all;
        glm::dvec3 power{0.0};
        double error = 0;
    };

    bool is_varying(std::span<const std::uint32_t> triangles) const;
    Parts parts_of(std::span<const std::uint32_t> triangles, double least_pieces, double tolerance) const;
    bool is_even(std::span<const std::uint32_t> triangles, const Parts& known) const;
    bool measure(Part& part, std::uint64_t index) const;
    glm::dvec2 lit_place(const Part& part, double along, double across, std::uint64_t index) const;

    const Scene& scene_;
    EmissionRange range_;
    double tolerance_;
    std::size_t most_parts_;
    mutable double largest_error_ = 0;
};

}  // namespace render
