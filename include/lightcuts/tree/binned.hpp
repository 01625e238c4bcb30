#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include "../core/random.hpp"
#include "longest_axis.hpp"
#include "record.hpp"

namespace lightcuts {

/// Splitter of `divide`: sorts a set into up to 16 bins along every axis of position (and direction) and takes the
/// boundary whose two sides have the smallest sum of the papers' cluster metric [Walter et al. 2005, Section 4].
struct Binned {
    std::size_t sample = 4096;  ///< a larger set chooses its boundary from about so many of its items

    template <class Record>
    std::pair<detail::Part<Record>, detail::Part<Record>> split(const detail::Part<Record>& part) const;
};

namespace detail {

/// One set of records, sorted into bins along each axis that matters.
template <class Record>
class Bins {
public:
    static constexpr std::size_t max_bins = 16;
    static constexpr std::size_t axis_count = Record::axes.size();

    Bins(const Bounds<Record>& bounds, std::size_t count) {
        bin_count_ = count >= 64 ? max_bins : count >= 16 ? max_bins / 2 : max_bins / 4;
        last_bin_ = static_cast<float>(bin_count_ - 1);
        const auto gains = bounds.gains();
        float threshold = 0;
        for (const float g : gains) threshold = std::max(threshold, g);
        threshold *= count >= 256 ? 0.05f : 0.25f;
        for (std::size_t i = 0; i < axis_count; ++i) {
            const std::size_t a = Record::axes[i];
            const float extent = bounds.hi[a] - bounds.lo[a];
            if (!(extent > 0) || gains[i] < threshold) continue;
            // Just under bin_count / extent, so that the upper end falls into the last bin; clamped all the same.
            scale_[live_count_] = std::min(static_cast<float>(bin_count_) * 0.999999f / extent,
                                           std::numeric_limits<float>::max());
            origin_[live_count_] = bounds.lo[a];
            live_[live_count_++] = a;
        }
        for (std::size_t k = 0; k < live_count_; ++k) {
            for (std::size_t b = 0; b < bin_count_; ++b) {
                bins_[k][b] = Bounds<Record>::none();
                weights_[k][b] = 0;
            }
        }
    }

    bool is_point() const { return live_count_ == 0; }

    void add(std::span<const Record> records) {
        for (std::size_t k = 0; k < live_count_; ++k) {
            for (const Record& r : records) {
                const std::size_t b = bin(r, k);
                bins_[k][b].add(r);
                weights_[k][b] += r.weight();
            }
        }
    }

    struct Boundary {
        std::size_t axis = 0;  ///< among the live ones
        std::size_t first_right = 0;
        double cost = std::numeric_limits<double>::infinity();
    };

    /// The boundary with the smallest sum of metrics. pre: !is_point().
    Boundary best_boundary() const {
        Boundary best;
        for (std::size_t k = 0; k < live_count_; ++k) {
            // Step 1: costs of the right sides, from the end.
            std::array<double, max_bins> right_cost;
            Bounds<Record> side = Bounds<Record>::none();
            double weight = 0;
            for (std::size_t b = bin_count_ - 1; b > 0; --b) {
                side.add(bins_[k][b]);
                weight += static_cast<double>(weights_[k][b]);
                right_cost[b] = weight * static_cast<double>(side.size());
            }
            // Step 2: add those of the left sides.
            side = Bounds<Record>::none();
            weight = 0;
            for (std::size_t b = 1; b < bin_count_; ++b) {
                side.add(bins_[k][b - 1]);
                weight += static_cast<double>(weights_[k][b - 1]);
                const double cost = weight * static_cast<double>(side.size()) + right_cost[b];
                if (cost < best.cost) best = {k, b, cost};
            }
        }
        return best;
    }

    bool goes_left(const Record& r, const Boundary& boundary) const {
        return bin(r, boundary.axis) < boundary.first_right;
    }

    Bounds<Record> bounds(std::size_t axis, std::size_t first, std::size_t last) const {
        Bounds<Record> side = Bounds<Record>::none();
        for (std::size_t b = first; b < last; ++b) side.add(bins_[axis][b]);
        return side;
    }
    Bounds<Record> left_bounds(const Boundary& b) const { return bounds(b.axis, 0, b.first_right); }
    Bounds<Record> right_bounds(const Boundary& b) const { return bounds(b.axis, b.first_right, bin_count_); }

private:
    std::size_t bin(const Record& r, std::size_t k) const {
        const float t = (r.lane[live_[k]] - origin_[k]) * scale_[k];
        return static_cast<std::size_t>(static_cast<int>(std::max(0.0f, std::min(t, last_bin_))));
    }

    std::size_t bin_count_ = 0;
    float last_bin_ = 0;
    std::size_t live_count_ = 0;
    std::array<std::size_t, axis_count> live_{};
    std::array<float, axis_count> scale_{}, origin_{};
    std::array<std::array<Bounds<Record>, max_bins>, axis_count> bins_;
    std::array<std::array<float, max_bins>, axis_count> weights_;
};

/// Visits `size` of the records, in chunks, one record from each of as many equal stretches: no order of the items
/// can fool it.
template <class Record, class Visit>
void visit_sample(std::span<const Record> records, std::size_t size, Visit&& visit) {
    std::array<Record, 64> chunk;
    const std::size_t stride = records.size() / size;
    for (std::size_t i = 0; i < size;) {
        std::size_t count = 0;
        for (; count < chunk.size() && i < size; ++count, ++i) {
            chunk[count] = records[i * stride + hash_keys(i, records.size()) % stride];
        }
        visit(std::span<const Record>(chunk.data(), count));
    }
}

}  // namespace detail

template <class Record>
std::pair<detail::Part<Record>, detail::Part<Record>> Binned::split(const detail::Part<Record>& part) const {
    const std::span<Record> records = part.records;
    const auto none = detail::Bounds<Record>::none();
    const auto halves = [&](std::size_t left, const auto& left_bounds, const auto& right_bounds) {
        return std::pair{detail::Part<Record>{records.first(left), left_bounds},
                         detail::Part<Record>{records.subspan(left), right_bounds}};
    };

    const std::size_t size = records.size();
    const bool sampled = sample > 0 && size >= 2 * sample;
    const std::size_t used = std::max(sample, size / 8);
    detail::Bounds<Record> bounds = part.bounds;
    if (sampled) {
        bounds = none;
        detail::visit_sample<Record>(records, used, [&](std::span<const Record> chunk) { bounds.add(detail::Bounds<Record>::of(chunk)); });
    } else if (bounds.is_none()) {
        bounds = detail::Bounds<Record>::of(records);
    }

    detail::Bins<Record> bins(bounds, records.size());
    if (bins.is_point()) {
        // A sample can be a point where the set is not: its median is then as good a place as any.
        return sampled ? LongestAxis{}.split(part) : halves(records.size() / 2, bounds, bounds);
    }
    if (sampled) {
        detail::visit_sample<Record>(records, used, [&](std::span<const Record> chunk) { bins.add(chunk); });
    } else {
        bins.add(records);
    }
    const auto boundary = bins.best_boundary();
    const std::size_t left =
        detail::partition_records(records, [&](const Record& r) { return bins.goes_left(r, boundary); });
    if (left == 0 || left == size) return halves(records.size() / 2, none, none);
    return sampled ? halves(left, none, none) : halves(left, bins.left_bounds(boundary), bins.right_bounds(boundary));
}

}  // namespace lightcuts
