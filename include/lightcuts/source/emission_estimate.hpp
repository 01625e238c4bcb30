#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "../core/random.hpp"
#include "emitter.hpp"
#include "equal_power_strata.hpp"
#include "triangle_pieces.hpp"

namespace lightcuts {

/// How well the light of textured emitters is known. None of it matters to triangles of one radiance each.
struct EmissionAccuracy {
    /// At least so many pieces of equal area are looked at, so that lights lie where the light is.
    std::size_t pieces = 4096;
    /// Of a `BoundedEmissiveMesh`: pieces are cut until the standard deviation of the power is no more than this share.
    double tolerance = 0.0025;
    /// Of a `BoundedEmissiveMesh`: about the most pieces to be looked at beyond the first ones.
    std::size_t most_cuts = std::size_t{1} << 19;
};

namespace detail {

/// The mean radiance of a piece of texture is that of so many points, one in each of its sixteenths.
inline constexpr int points_per_piece = 16;
/// A channel with less than this share of the brightest one's power is measured by that.
inline constexpr double faint_channel = 1e-4;

/// What is known of the radiance of a piece, channel by channel: area times ...
template <Spectrum S>
struct PieceDoubt {
    using Channels = std::array<double, static_cast<std::size_t>(channels_of<S>)>;
    Channels range{};      ///< ... the width of its bounds
    Channels deviation{};  ///< ... its standard deviation, at most

    bool is_known() const { return range == Channels{}; }
};

/// Pieces of all that emits of an emitter, and how far the sum of their powers may be off.
template <Spectrum S>
struct EmissionEstimate {
    std::vector<TrianglePiece<S>> pieces;
    std::vector<PieceDoubt<S>> doubts;  ///< of each piece; all known where there are no bounds
    double area = 0;                    ///< of all sides, dark ones as well
    double power = 0;                   ///< area x radiance, sum of channels
    double error = 0;                   ///< standard deviation of the power, at most, as a share
};

/// Sets the mean radiance of a piece of texture, and a point that shines. With bounds, each of the points looked at is
/// drawn by a hash of `index`: points of a grid would all fall on bars of a grating, or between them, and their error
/// could not be told. Without, the points are the middles of the sixteenths, exact where radiance is linear.
template <EmissiveMesh E>
void look_at(const E& emitter, TrianglePiece<emitter_spectrum<E>>& piece, [[maybe_unused]] std::uint64_t index) {
    const auto& [a, b, c] = piece.corners;
    const glm::vec2 along = 0.25f * (b - a), up = 0.25f * (c - a);
    SpectrumSum<emitter_spectrum<E>> sum;
    [[maybe_unused]] std::uint64_t drawn = 0;
    const auto take = [&](const glm::vec2& corner, float side) {  // of the sixteenth that stands, or hangs, there
        float s = 1.0f / 3.0f, t = 1.0f / 3.0f;
        if constexpr (BoundedEmissiveMesh<E>) {
            const std::uint64_t bits = hash_keys(piece.triangle, index, drawn++);
            s = static_cast<float>(uniform01(bits));
            t = static_cast<float>(uniform01(mix_bits(bits)));
            if (s + t > 1.0f) {
                s = 1.0f - s;
                t = 1.0f - t;
            }
        }
        const glm::vec2 uv = corner + side * (s * along + t * up);
        const emitter_spectrum<E> radiance = emitter.radiance(piece.triangle, uv);
        validate_radiance(radiance, piece.triangle);
        if (channel_sum(radiance) > 0.0) piece.lit = uv;
        sum.add(radiance, 1.0 / points_per_piece);
    };
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4 - i; ++j) {
            const glm::vec2 corner = a + along * static_cast<float>(i) + up * static_cast<float>(j);
            take(corner, 1.0f);
            if (i + j < 3) take(corner + along + up, -1.0f);
        }
    }
    piece.radiance = sum.value();
}

/// The largest standard deviation of what lies between `low` and `high` and has that mean [Bhatia and Davis 2000]. As
/// the mean of a few points may miss what is bright or dark, it counts as not too near to the ends.
inline double largest_deviation(double low, double high, double mean) {
    const double least = (high - low) / 64.0;
    return std::sqrt((std::max)(mean - low, least) * (std::max)(high - mean, least));
}

/// Looks at pieces of an emitter, and cuts those of which it knows least.
template <EmissiveMesh E>
class EmissionEstimator {
public:
    using S = emitter_spectrum<E>;
    using Piece = TrianglePiece<S>;
    using Doubt = PieceDoubt<S>;

    /// `emitter` must outlive this object.
    explicit EmissionEstimator(const E& emitter) : emitter_(emitter) {}

    /// throws: invalid_input naming the triangle with a corner or radiance that is not finite or a negative radiance
    EmissionEstimate<S> operator()(const EmissionAccuracy& accuracy) {
        estimate_ = {};
        measured_ = 0;
        const std::vector<Piece> sides = sides_of(emitter_);
        for (const Piece& side : sides) estimate_.area += side.area;
        const double largest = estimate_.area / static_cast<double>((std::max)(accuracy.pieces, std::size_t{1}));
        std::vector<Piece> parts;
        for (const Piece& side : sides) {
            if (!is_textured(emitter_, side.triangle)) {
                append(side, {});
                continue;
            }
            parts.clear();
            cut_until(
                emitter_, side, [&](const Piece& piece) { return piece.area <= largest; }, parts);
            for (Piece& part : parts) {
                Doubt doubt;
                if (measure(part, doubt)) append(part, doubt);
            }
        }
        if constexpr (BoundedEmissiveMesh<E>) refine(accuracy);
        for (const Piece& piece : estimate_.pieces) estimate_.power += piece.power();
        return std::move(estimate_);
    }

private:
    using Channels = typename Doubt::Channels;

    struct Open {
        double range = 0;
        double variance = 0;
        std::size_t piece = 0;
    };

    void append(const Piece& piece, const Doubt& doubt) {
        estimate_.pieces.push_back(piece);
        estimate_.doubts.push_back(doubt);
    }

    /// False if the piece is dark.
    bool measure(Piece& piece, [[maybe_unused]] Doubt& doubt) {
        const std::uint64_t index = measured_++;
        if constexpr (BoundedEmissiveMesh<E>) {
            const RadianceRange<S> range = emitter_.radiance_range(piece.triangle, piece.corners);
            validate_radiance(range.high, piece.triangle);
            bool is_dark = true;
            for (std::size_t i = 0; i < doubt.range.size(); ++i) {
                const auto low = static_cast<double>(channel(range.low, static_cast<int>(i)));
                const auto high = static_cast<double>(channel(range.high, static_cast<int>(i)));
                doubt.range[i] = piece.area * (high - low);
                is_dark = is_dark && !(high > 0.0);
            }
            if (is_dark) return false;
            piece.radiance = range.low;
            if (doubt.is_known()) return true;
            look_at(emitter_, piece, index);
            for (int i = 0; i < channels_of<S>; ++i) {
                const auto value = [&](const S& s) { return static_cast<double>(channel(s, i)); };
                doubt.deviation[static_cast<std::size_t>(i)] = piece.area * largest_deviation(value(range.low),
                                                                                              value(range.high),
                                                                                              value(piece.radiance));
            }
        } else {
            look_at(emitter_, piece, index);
        }
        return true;
    }

    /// What the channels of doubts are measured by: the power, or the faintest that counts.
    Channels whole() const {
        SpectrumSum<S> sum;
        for (const Piece& piece : estimate_.pieces) sum.add(piece.radiance, piece.area);
        Channels power = sum.sums();
        const double least = (std::max)(faint_channel * *std::max_element(power.begin(), power.end()), 1e-300);
        for (double& p : power) p = (std::max)(p, least);
        return power;
    }

    /// The pieces that are not known and can be cut. `sum`: their variance together; `fixed`: of those that cannot be.
    std::vector<Open> open_pieces(double& sum, double& fixed) const {
        const Channels power = whole();
        const auto largest = [&](const Channels& c) {
            double most = 0.0;
            for (std::size_t i = 0; i < c.size(); ++i) most = (std::max)(most, c[i] / power[i]);
            return (std::min)(most, 1e100);
        };
        std::vector<Open> open;
        for (std::size_t i = 0; i < estimate_.pieces.size(); ++i) {
            const double range = largest(estimate_.doubts[i].range);
            if (!(range > 0.0)) continue;
            const double deviation = largest(estimate_.doubts[i].deviation);
            const double variance = deviation * deviation;
            const bool can_be_cut = estimate_.pieces[i].can_be_halved();
            (can_be_cut ? sum : fixed) += variance;
            if (can_be_cut) open.push_back({range, variance, i});
        }
        return open;
    }

    void refine(const EmissionAccuracy& accuracy) requires BoundedEmissiveMesh<E> {
        // The deviation of the sum is that of its pieces, which are independent: of a point by the root of the points.
        const double most_doubt = std::sqrt(static_cast<double>(points_per_piece)) * accuracy.tolerance;
        const double allowed = most_doubt * most_doubt;
        const std::uint64_t most = measured_ + accuracy.most_cuts;
        for (;;) {
            double sum = 0.0, fixed = 0.0;
            std::vector<Open> open = open_pieces(sum, fixed);
            if (sum <= allowed || open.empty() || measured_ >= most) {
                estimate_.error = std::sqrt((sum + fixed) / static_cast<double>(points_per_piece));
                return;
            }
            // The pieces of the largest ranges, until what is left would be little. Not those of the largest
            // deviations, which are of pieces whose points happened to be bright: to look twice at these alone would
            // lose light.
            std::sort(open.begin(), open.end(), [](const Open& a, const Open& b) {
                return a.range > b.range || (a.range == b.range && a.piece < b.piece);
            });
            std::size_t count = 0;
            for (double left = sum; count < open.size() && left > 0.25 * allowed && measured_ + 2 * count < most;) {
                left -= open[count++].variance;
            }
            for (std::size_t k = 0; k < count; ++k) halve(open[k].piece);
            drop_dark();
        }
    }

    void halve(std::size_t i) requires BoundedEmissiveMesh<E> {
        const Piece piece = estimate_.pieces[i];
        // Stays if both halves are dark, of no power, to be dropped.
        estimate_.pieces[i].radiance = black<S>();
        estimate_.doubts[i] = {};
        bool is_replaced = false;
        for (Piece half : piece.halves(edge_to_cut(piece))) {
            Doubt doubt;
            if (!measure(half, doubt)) continue;
            if (is_replaced) {
                append(half, doubt);
            } else {
                estimate_.pieces[i] = half;
                estimate_.doubts[i] = doubt;
            }
            is_replaced = true;
        }
    }

    std::size_t edge_to_cut(const Piece& piece) const {
        if constexpr (requires { emitter_.edge_to_cut(piece.triangle, piece.corners); }) {
            const std::optional<std::size_t> edge = emitter_.edge_to_cut(piece.triangle, piece.corners);
            if (edge) return *edge;
        }
        return longest_edge(facet_of(emitter_, piece.triangle), piece.corners);
    }

    void drop_dark() {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < estimate_.pieces.size(); ++i) {
            if (!(estimate_.pieces[i].power() > 0.0) && estimate_.doubts[i].is_known()) continue;
            estimate_.pieces[kept] = estimate_.pieces[i];
            estimate_.doubts[kept++] = estimate_.doubts[i];
        }
        estimate_.pieces.resize(kept);
        estimate_.doubts.resize(kept);
    }

    const E& emitter_;
    EmissionEstimate<S> estimate_;
    std::uint64_t measured_ = 0;  ///< pieces so far
};

}  // namespace detail
}  // namespace lightcuts
