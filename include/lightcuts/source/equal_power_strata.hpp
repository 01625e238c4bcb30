#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "../core/spectrum.hpp"
#include "sampler.hpp"

namespace lightcuts::detail {

/// A sum of spectra, in double.
template <Spectrum S>
class SpectrumSum {
public:
    void add(const S& s, double scale) {
        for (int i = 0; i < channels_of<S>; ++i) {
            sums_[static_cast<std::size_t>(i)] += static_cast<double>(channel(s, i)) * scale;
        }
    }
    const auto& sums() const { return sums_; }
    S value() const {
        return make_spectrum<S>([&](int i) { return sums_[static_cast<std::size_t>(i)]; });
    }

private:
    std::array<double, static_cast<std::size_t>(channels_of<S>)> sums_{};
};

/// One of several strata of equal weight of a stream of pieces, and the point of it where its light goes.
template <class Piece, Spectrum S>
struct PowerStratum {
    Piece piece{};         ///< that the point lies in
    double fraction = 0;   ///< of the piece before the point, in [0, 1)
    S power = black<S>();  ///< of the whole stratum
};

/// Cuts a stream of pieces, consecutive along some curve, into `count` strata of equal weight. A piece may be cut into
/// many strata, and a stratum may hold many pieces; the power of all pieces is in the strata, channel by channel. The
/// point of stratum i lies at the fraction sampler(i, 0) of its weight.
template <class Piece, Spectrum S, Sampler Sequence>
class EqualPowerStrata {
public:
    /// `total`: the weights of all pieces. pre: total > 0, count > 0
    EqualPowerStrata(double total, std::size_t count, const Sequence& sampler)
        : size_(total / static_cast<double>(count)), count_(count), sampler_(sampler) {
        strata_.reserve(count);
        start_stratum();
    }

    /// Appends a piece whose power is `spectrum` x `scale`.
    void add(const Piece& piece, double weight, const S& spectrum, double scale) {
        if (!(weight > 0.0)) return;
        double used = 0.0;  // of the piece
        // Rounding may leave the last stratum short of its end or beyond it: it takes what is left.
        while (filled_ + (weight - used) >= size_ && strata_.size() + 1 < count_) {
            const double part = size_ - filled_;
            take(piece, used, part, weight, spectrum, scale);
            used += part;
            finish_stratum();
        }
        take(piece, used, weight - used, weight, spectrum, scale);
    }

    /// The strata. pre: all pieces were added, nothing is added afterwards
    std::vector<PowerStratum<Piece, S>> finish() {
        // Weights that add up to less than `total`, by rounding.
        while (strata_.size() < count_) finish_stratum();
        return std::move(strata_);
    }

private:
    void take(const Piece& piece, double from, double part, double weight, const S& spectrum, double scale) {
        if (!(part > 0.0)) return;
        const double mark = at_ * size_;
        if (filled_ <= mark) {  // the last piece that begins before the mark
            const double fraction = (from + (mark - filled_)) / weight;
            current_.piece = piece;
            current_.fraction = fraction < largest_below_one ? fraction : largest_below_one;
        }
        power_.add(spectrum, scale * (part / weight));
        filled_ += part;
    }
    void start_stratum() {
        filled_ = 0.0;
        power_ = {};
        at_ = static_cast<double>(sampler_(static_cast<std::uint32_t>(strata_.size()), 0));
    }
    void finish_stratum() {
        current_.power = power_.value();
        strata_.push_back(current_);
        start_stratum();
    }

    static constexpr double largest_below_one = 1.0 - 0x1p-53;

    double size_;
    std::size_t count_;
    const Sequence& sampler_;
    std::vector<PowerStratum<Piece, S>> strata_;
    PowerStratum<Piece, S> current_;
    SpectrumSum<S> power_;
    double filled_ = 0.0;
    double at_ = 0.0;
};

}  // namespace lightcuts::detail
