#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include "../core/random.hpp"
#include "longest_axis.hpp"
#include "record.hpp"

namespace lightcuts {

/// Splitter of `divide`: sorts a set into up to 16 bins along each axis of position (and direction) and takes the
/// boundary whose two sides have the smallest sum of intensity x size. The size of items without an axis is the papers'
/// [Walter et al. 2005, Section 4], the squared diagonal of their box; with one it is the diagonal plus a share of that
/// of the axes' box, which leads to smaller cuts than the papers' sum of squares.
struct Binned {
    /// A set of more than twice as many items chooses its boundary from a sample of so many, or of an eighth of them
    /// if that is more. 0: always from all; slower by a sixth, and hardly a better tree.
    std::size_t sample = 4096;

    template <class Record>
    detail::Halves<Record> split(const detail::Part<Record>& part) const;
};

namespace detail {

/// One set of records, sorted into bins along each axis that matters.
template <class Record>
class Bins {
public:
    static constexpr std::size_t max_bins = 16;
    static constexpr std::size_t axis_count = Record::axes.size();

    /// `count`: of the records that will be split, not all of which need be added.
    Bins(const Bounds<Record>& bounds, std::size_t count) {
        bin_count_ = count >= 64 ? max_bins : count >= 16 ? max_bins / 2 : max_bins / 4;
        // An axis that promises little beside another is not worth its bins, least of all for a small set.
        const auto gains = bounds.gains();
        const float share = count >= 256 ? 0.05f : count >= 16 ? 0.25f : 0.5f;
        const float least_gain = share * *std::max_element(gains.begin(), gains.end());
        for (std::size_t i = 0; i < axis_count; ++i) {
            const std::size_t a = Record::axes[i];
            const float extent = bounds.hi[a] - bounds.lo[a];
            if (!(extent > 0) || gains[i] < least_gain) continue;
            // Just under bin_count / extent, so that the upper end falls into the last bin.
            const float scale = static_cast<float>(bin_count_) * 0.999999f / extent;
            axes_[live_count_++] = {a, bounds.lo[a], (std::min)(scale, (std::numeric_limits<float>::max)()),
                                    static_cast<float>(bin_count_ - 1)};
        }
        for (std::size_t k = 0; k < live_count_; ++k) {
            std::fill_n(bins_[k].begin(), bin_count_, Bounds<Record>::none());
            std::fill_n(weights_[k].begin(), bin_count_, 0.0f);
        }
    }

    /// All records coincide: there is nothing to choose.
    bool is_point() const { return live_count_ == 0; }

    void add(std::span<const Record> records) {
        for (std::size_t k = 0; k < live_count_; ++k) {
            const Axis axis = axes_[k];
            for (const Record& r : records) {
                const std::size_t b = axis.bin(r);
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

    /// The boundary with the smallest sum of metrics. pre: !is_point(); some records were added.
    Boundary best_boundary() const {
        Boundary best;
        // The metric of a side without records is NaN, which is never the smallest.
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

    /// The predicate of the records on the left of a boundary.
    auto is_left(const Boundary& boundary) const {
        return [axis = axes_[boundary.axis], first_right = boundary.first_right](const Record& r) {
            return axis.bin(r) < first_right;
        };
    }

    Bounds<Record> left_bounds(const Boundary& b) const { return bounds(b.axis, 0, b.first_right); }
    Bounds<Record> right_bounds(const Boundary& b) const { return bounds(b.axis, b.first_right, bin_count_); }

private:
    struct Axis {
        std::size_t lane;
        float origin, scale, last_bin;

        std::size_t bin(const Record& r) const {
            const float t = (r.lane[lane] - origin) * scale;
            return static_cast<std::size_t>(static_cast<int>((std::max)(0.0f, (std::min)(t, last_bin))));
        }
    };

    Bounds<Record> bounds(std::size_t axis, std::size_t first, std::size_t last) const {
        Bounds<Record> side = Bounds<Record>::none();
        for (std::size_t b = first; b < last; ++b) side.add(bins_[axis][b]);
        return side;
    }

    std::size_t bin_count_ = 0;
    std::size_t live_count_ = 0;
    std::array<Axis, axis_count> axes_;
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

/// Moves the record to the end without which the other two are the smallest cluster. pre: three records.
template <class Record>
void single_out(std::span<Record> records) {
    std::size_t odd = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const Record &a = records[(i + 1) % 3], &b = records[(i + 2) % 3];
        Bounds<Record> pair = Bounds<Record>::none();
        pair.add(a);
        pair.add(b);
        const double size = (static_cast<double>(a.weight()) + static_cast<double>(b.weight())) *
                            static_cast<double>(pair.size());
        if (size < least) {
            least = size;
            odd = i;
        }
    }
    std::swap(records[odd], records[2]);
}

}  // namespace detail

template <class Record>
detail::Halves<Record> Binned::split(const detail::Part<Record>& part) const {
    using Bounds = detail::Bounds<Record>;
    const std::span<Record> records = part.records;
    const auto halves = [records](std::size_t left, const Bounds& left_bounds, const Bounds& right_bounds) {
        return detail::Halves<Record>{{records.first(left), left_bounds}, {records.subspan(left), right_bounds}};
    };
    if (records.size() == 3) {
        detail::single_out(records);
        return halves(2, Bounds::none(), Bounds::none());
    }
    const bool sampled = sample > 0 && records.size() > 2 * sample;
    const auto visit = [&](auto&& visitor) {
        if (sampled) {
            detail::visit_sample<Record>(records, (std::max)(sample, records.size() / 8), visitor);
        } else {
            visitor(std::span<const Record>(records));
        }
    };

    Bounds bounds = part.bounds;
    if (sampled || bounds.is_none()) {
        bounds = Bounds::none();
        visit([&](std::span<const Record> some) { bounds.add(Bounds::of(some)); });
    }
    detail::Bins<Record> bins(bounds, records.size());
    if (bins.is_point()) {
        // A sample can be a point where the set is not.
        return sampled ? LongestAxis{}.split(part) : halves(records.size() / 2, bounds, bounds);
    }
    visit([&](std::span<const Record> some) { bins.add(some); });
    const auto boundary = bins.best_boundary();
    const std::size_t left = detail::partition_records(records, bins.is_left(boundary));
    // An extent too small for 1 / extent leaves all records in one bin.
    if (left == 0 || left == records.size()) return halves(records.size() / 2, Bounds::none(), Bounds::none());
    if (sampled) return halves(left, Bounds::none(), Bounds::none());
    return halves(left, bins.left_bounds(boundary), bins.right_bounds(boundary));
}

}  // namespace lightcuts
