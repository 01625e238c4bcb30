#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "../core/invalid_input.hpp"
#include "../light/oriented.hpp"
#include "emission_estimate.hpp"
#include "emitter.hpp"
#include "equal_power_strata.hpp"
#include "flat_surface.hpp"
#include "sampler.hpp"
#include "spatial_order.hpp"
#include "triangle_pieces.hpp"

namespace lightcuts {

/// A point of an emitter, and the share of its emission for which it stands.
template <Spectrum S = glm::vec3>
struct EmitterSample {
    glm::vec3 position{0.0f};
    glm::vec3 normal{0.0f};  ///< unit, of the triangle, on the side that shines
    std::uint32_t triangle = 0;
    S intensity = black<S>();  ///< along the normal, W/sr: radiance x area
};

namespace detail {

/// Not unit, away from the side that shines.
template <EmissiveMesh E>
glm::dvec3 normal_of(const E& emitter, const TrianglePiece<emitter_spectrum<E>>& piece) {
    const glm::dvec3 cross = facet_of(emitter, piece.triangle).cross();
    return piece.back ? -cross : cross;
}

/// The order of pieces in which consecutive ones face alike and lie close together.
template <EmissiveMesh E>
std::vector<std::uint32_t> compact_order(const E& emitter,
                                         const std::vector<TrianglePiece<emitter_spectrum<E>>>& pieces) {
    std::vector<OrientedPlace> places;
    places.reserve(pieces.size());
    glm::dvec3 low((std::numeric_limits<double>::max)()), high(-low);
    for (const auto& piece : pieces) {
        const Facet f = facet_of(emitter, piece.triangle);
        low = (glm::min)(low, (glm::min)(f.a, (glm::min)(f.b, f.c)));
        high = (glm::max)(high, (glm::max)(f.a, (glm::max)(f.b, f.c)));
        places.push_back({f.at(piece.middle()), normal_of(emitter, piece)});
    }
    return spatial_order(places, low, (std::max)({high.x - low.x, high.y - low.y, high.z - low.z}));
}

/// Pieces are this much smaller than a sample's share, so that a share is a compact patch.
inline constexpr std::size_t pieces_per_sample = 4;

}  // namespace detail

/// What an emitter emits, looked at once, and points that stand for it, as many as are wanted and as often. `emitter`
/// must outlive this object.
///
/// The radiance of a triangle without texture is known. Textures are looked at in pieces of equal area, `accuracy` says
/// how many; those of a `BoundedEmissiveMesh` are then cut where their bounds are widest, until the power is known to
/// the tolerance: no spot is too small to be found.
template <EmissiveMesh E>
class EmitterSampler {
public:
    using S = emitter_spectrum<E>;

    /// throws: invalid_input naming the triangle with a corner or radiance that is not finite or a negative radiance.
    /// cost: 16 points a piece of texture; O(cuts log cuts) where there are bounds
    explicit EmitterSampler(const E& emitter, const EmissionAccuracy& accuracy = {})
        : emitter_(emitter), estimate_(detail::EmissionEstimator<E>(emitter)(accuracy)) {}
    /// Deleted: the emitter would be gone. Keep it in a variable.
    explicit EmitterSampler(const E&&, const EmissionAccuracy& = {}) = delete;

    /// Of all sides that shine, bright or dark, m^2.
    double area() const { return estimate_.area; }
    /// Radiance x area, sum of channels: 1 / pi of the flux. 0 iff all is black.
    double power() const { return estimate_.power; }
    /// Of a `BoundedEmissiveMesh`: the largest standard deviation that the power may have, as a share; above the
    /// tolerance where cuts ran out.
    double relative_error() const { return estimate_.error; }

    /// `count` points of equal power, none if all is black. Together they emit what the emitter does, channel by
    /// channel.
    ///
    /// A flat surface of one radiance that shines on one side has the points (`sampler(i, 2)`, `sampler(i, 3)`) of the
    /// smallest rectangle around it that lie on it: they do not depend on its triangles. Any other surface is cut into
    /// `count` compact patches of equal power, and point i is drawn from patch i by `sampler(i, 0)` and
    /// `sampler(i, 1)`; by further pairs of dimensions where that finds a black spot of a texture.
    /// cost: O((P + count) log(P + count)) for P pieces
    template <Sampler Sequence = ScrambledSobol>
    std::vector<EmitterSample<S>> samples(std::size_t count, const Sequence& sampler = {}) const {
        if (count == 0 || !(estimate_.power > 0.0)) return {};
        if (is_even()) {
            std::vector<EmitterSample<S>> samples = samples_on_flat(count, sampler);
            if (!samples.empty()) return samples;
        }
        return samples_of_patches(count, sampler);
    }

private:
    using Piece = detail::TrianglePiece<S>;

    /// True iff one radiance is known to be that of every point.
    bool is_even() const {
        constexpr double rounding = 1e-6;
        detail::SpectrumSum<S> sum;
        for (const Piece& piece : estimate_.pieces) sum.add(piece.radiance, piece.area / estimate_.area);
        const auto& mean = sum.sums();
        const double most = rounding * *std::max_element(mean.begin(), mean.end());
        for (std::size_t i = 0; i < estimate_.pieces.size(); ++i) {
            const Piece& piece = estimate_.pieces[i];
            if (detail::is_textured(emitter_, piece.triangle) && !BoundedEmissiveMesh<E>) return false;
            if (!estimate_.doubts[i].is_known()) return false;
            for (int c = 0; c < channels_of<S>; ++c) {
                const auto here = static_cast<double>(channel(piece.radiance, c));
                if (std::fabs(here - mean[static_cast<std::size_t>(c)]) > most) return false;
            }
        }
        return true;
    }

    /// Empty if the surface is not flat, or shines on both sides.
    template <Sampler Sequence>
    std::vector<EmitterSample<S>> samples_on_flat(std::size_t count, const Sequence& sampler) const {
        std::vector<std::uint32_t> triangles;
        detail::SpectrumSum<S> power;
        for (const Piece& piece : estimate_.pieces) {
            if (piece.back) return {};
            power.add(piece.radiance, piece.area / static_cast<double>(count));
            triangles.push_back(piece.triangle);
        }
        std::sort(triangles.begin(), triangles.end());
        triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
        std::vector<detail::Facet> facets;
        facets.reserve(triangles.size());
        for (const std::uint32_t t : triangles) facets.push_back(detail::facet_of(emitter_, t));
        std::vector<EmitterSample<S>> samples;
        const auto surface = detail::FlatSurface::of(facets);
        if (!surface) return samples;
        samples.reserve(count);
        for (const auto& place : surface->points(count, sampler)) {
            samples.push_back(
                {glm::vec3(place.position), glm::vec3(surface->normal()), triangles[place.facet], power.value()});
        }
        return samples;
    }

    template <Sampler Sequence>
    std::vector<EmitterSample<S>> samples_of_patches(std::size_t count, const Sequence& sampler) const {
        const double largest = estimate_.power / static_cast<double>(detail::pieces_per_sample * count);
        std::vector<Piece> pieces;
        for (std::size_t i = 0; i < estimate_.pieces.size(); ++i) {
            const Piece& piece = estimate_.pieces[i];
            if (!(piece.power() > 0.0)) continue;
            // All light of a piece of bounds that are apart may come from one part of it.
            const bool is_even = estimate_.doubts[i].is_known();
            detail::cut_until(
                emitter_, piece, [&](const Piece& p) { return !is_even || p.power() <= largest; }, pieces);
        }
        detail::EqualPowerStrata<std::uint32_t, S, Sequence> patches(estimate_.power, count, sampler);
        for (const std::uint32_t i : detail::compact_order(emitter_, pieces)) {
            patches.add(i, pieces[i].power(), pieces[i].radiance, pieces[i].area);
        }
        std::vector<EmitterSample<S>> samples;
        samples.reserve(count);
        for (const auto& patch : patches.finish()) {
            const Piece& piece = pieces[patch.piece];
            const auto index = static_cast<std::uint32_t>(samples.size());
            const glm::dvec3 point = detail::facet_of(emitter_, piece.triangle)
                                         .at(lit_place(piece, patch.fraction, index, sampler));
            const glm::dvec3 normal = glm::normalize(detail::normal_of(emitter_, piece));
            samples.push_back({glm::vec3(point), glm::vec3(normal), piece.triangle, patch.power});
        }
        return samples;
    }

    /// Never in the holes of a mask, nor where a texture is black.
    template <Sampler Sequence>
    glm::dvec2 lit_place(const Piece& piece, double along, std::uint32_t index, const Sequence& sampler) const {
        constexpr std::uint32_t most_tries = 32;
        glm::dvec2 place = piece.at(along, static_cast<double>(sampler(index, 1)));
        if (!detail::is_textured(emitter_, piece.triangle)) return place;
        for (std::uint32_t tries = 1;; ++tries) {
            if (channel_sum(S(emitter_.radiance(piece.triangle, glm::vec2(place)))) > 0.0) return place;
            if (tries == most_tries) return glm::dvec2(piece.lit);
            // Dimensions 2 and 3 are those of flat surfaces.
            place = piece.at(static_cast<double>(sampler(index, 2 * tries + 2)),
                             static_cast<double>(sampler(index, 2 * tries + 3)));
        }
    }

    const E& emitter_;
    detail::EmissionEstimate<S> estimate_;
};

/// `count` oriented lights of equal power (sum of channels) that stand for a diffuse emitter, at the points that
/// `EmitterSampler` draws: dense where radiance is high and evenly spread where it is constant, not in rows, which
/// would show in the shadows of straight edges. All lights together emit what the emitter does, channel by channel: pi
/// x the sum of intensities is the flux pi x radiance x area. A textured emitter's is found from at least 16 x 4096
/// points of it, and by bounds if it has them.
///
/// throws: invalid_input if no triangle has an area or all are black, or naming the triangle with a corner or radiance
/// that is not finite or a negative radiance. cost: O((T + count) log(T + count)), and what an `EmitterSampler` costs
template <EmissiveMesh E, Sampler Sequence = ScrambledSobol>
std::vector<OrientedPointLight<emitter_spectrum<E>>> area_lights(const E& emitter, std::size_t count,
                                                                 const Sequence& sampler = {}) {
    EmissionAccuracy accuracy;
    accuracy.pieces = (std::max)(accuracy.pieces, detail::pieces_per_sample * count);
    const EmitterSampler<E> points(emitter, accuracy);
    if (!(points.area() > 0.0)) {
        LIGHTCUTS_THROW(
            invalid_input("emitter: its " + std::to_string(emitter.triangle_count()) + " triangles have no area"));
    }
    if (!(points.power() > 0.0)) LIGHTCUTS_THROW(invalid_input("emitter: all its triangles are black"));
    std::vector<OrientedPointLight<emitter_spectrum<E>>> lights;
    lights.reserve(count);
    for (const auto& sample : points.samples(count, sampler)) {
        lights.push_back({sample.position, sample.normal, sample.intensity, {}});
    }
    return lights;
}

}  // namespace lightcuts
