#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "../../core/assertion.hpp"
#include "../../core/invalid_input.hpp"
#include "build_range.hpp"
#include "normalized_space.hpp"

namespace lightcuts {

namespace detail {

/// Halves a set about two centers: each item belongs to the nearer one as far as both get as many.
/// `Metric`: `Center`, `mean(items)` of a part, `distance(item, center)`.
template <std::size_t Dimensions, class Metric>
Split<Dimensions> split_by_two_centers(const BuildRange<Dimensions>& range, int iterations, const Metric& metric) {
    using Item = BuildItem<Dimensions>;
    struct Keyed {
        double key;
        Item item;
    };
    std::vector<Keyed> keyed;
    keyed.reserve(range.items.size());
    for (const Item& i : range.items) keyed.push_back({0.0, i});
    // Ties are broken by item, so that the halves are the same sets whatever the order was.
    const auto precedes = [](const Keyed& a, const Keyed& b) {
        return a.key != b.key ? a.key < b.key : a.item.item() < b.item.item();
    };
    const auto farthest_from = [&](const typename Metric::Center& center) {
        for (Keyed& k : keyed) k.key = metric.distance(k.item, center);
        return metric.mean(std::span(&std::max_element(keyed.begin(), keyed.end(), precedes)->item, 1));
    };
    const std::size_t left = keyed.size() / 2;
    const auto middle = keyed.begin() + static_cast<std::ptrdiff_t>(left);
    auto first = farthest_from(metric.mean(std::span<const Item>(range.items)));
    auto second = farthest_from(first);
    for (int i = 0; i < iterations; ++i) {
        for (Keyed& k : keyed) k.key = metric.distance(k.item, first) - metric.distance(k.item, second);
        std::nth_element(keyed.begin(), middle, keyed.end(), precedes);
        for (std::size_t k = 0; k < keyed.size(); ++k) range.items[k] = keyed[k].item;
        if (i + 1 == iterations) break;
        first = metric.mean(std::span<const Item>(range.items.first(left)));
        second = metric.mean(std::span<const Item>(range.items.subspan(left)));
    }
    return split_at(range, left);
}

/// K^2 |x - center|^2 + |n - mean normal|^2 in a space whose unit is the items' diagonal.
template <std::size_t Dimensions>
struct GeometricMetric {
    using Item = BuildItem<Dimensions>;
    using Center = std::array<double, Item::lanes>;

    double position_weight;  ///< K^2

    Center mean(std::span<const Item> items) const {
        Center c{};
        for (const Item& i : items) {
            for (const std::size_t a : Item::axes) c[a] += static_cast<double>(i.lane[a]);
        }
        for (double& x : c) x /= static_cast<double>(items.size());
        return c;
    }
    double distance(const Item& item, const Center& center) const {
        double sum = 0.0;
        for (const std::size_t a : Item::axes) {
            const double d = static_cast<double>(item.lane[a]) - center[a];
            sum += (a < 4 ? position_weight : 1.0) * d * d;
        }
        return sum;
    }
};

/// Scaled differences of visibility, mixed with the geometric metric.
template <std::size_t Dimensions>
struct VectorMetric {
    using Item = BuildItem<Dimensions>;
    struct Center {
        typename GeometricMetric<Dimensions>::Center geometric;
        std::vector<double> vector;
    };

    GeometricMetric<Dimensions> geometric;
    std::span<const float> vectors;
    std::size_t length;
    double geometric_weight = 1.0, vector_weight = 1.0;

    std::span<const float> vector_of(const Item& item) const {
        LIGHTCUTS_ASSERT((std::size_t{item.item()} + 1) * length <= vectors.size());
        return vectors.subspan(item.item() * length, length);
    }
    Center mean(std::span<const Item> items) const {
        Center c{geometric.mean(items), std::vector<double>(length, 0.0)};
        for (const Item& i : items) {
            const std::span<const float> v = vector_of(i);
            for (std::size_t k = 0; k < length; ++k) c.vector[k] += static_cast<double>(v[k]);
        }
        for (double& x : c.vector) x /= static_cast<double>(items.size());
        return c;
    }
    double vector_distance(const Item& item, const Center& center) const {
        const std::span<const float> v = vector_of(item);
        double sum = 0.0;
        for (std::size_t k = 0; k < length; ++k) {
            const double d = static_cast<double>(v[k]) - center.vector[k];
            sum += d * d;
        }
        return sum;
    }
    double distance(const Item& item, const Center& center) const {
        return vector_weight * vector_distance(item, center) +
               geometric_weight * geometric.distance(item, center.geometric);
    }
};

}  // namespace detail

/// Splitter of `divide`: halves a set evenly about two centers, so that the tree is complete, of depth ceil(log2 N)
/// [Cut merging 2008, section 3.4]. The centers start far apart and become the means of the halves in turn. The metric
/// is K^2 |x - center|^2 / diagonal^2 + |n - mean n|^2 [Eq. 10]; of directions on a sphere both x and n are the
/// direction.
struct TwoCenters {
    double position_factor = 30.0;  ///< K: how much positions count for beside normals; up to 1e100
    int iterations = 4;             ///< 1 or more

    /// throws: invalid_input if an option is out of its range.
    void check() const {
        // Squares of larger ones would not be finite.
        if (!(std::abs(position_factor) <= 1e100)) {
            LIGHTCUTS_THROW(invalid_input("two centers: position_factor " + std::to_string(position_factor) +
                                          " is not finite, or above 1e100"));
        }
        if (iterations < 1) {
            LIGHTCUTS_THROW(
                invalid_input("two centers: " + std::to_string(iterations) + " iterations; take 1 or more"));
        }
    }

    /// See `Splitter`; allocates room for the items and a number each. pre: `check` passes. cost: O(items x
    /// iterations).
    template <std::size_t Dimensions>
    Split<Dimensions> split(const BuildRange<Dimensions>& range, const NormalizedSpace&) const {
        return detail::split_by_two_centers(range, iterations,
                                            detail::GeometricMetric<Dimensions>{position_factor * position_factor});
    }
};

/// As `TwoCenters`, by what functions that were tried out have at each item: items that agree in nearly all of them are
/// neighbors in the tree, and the functions' cuts are smaller [Cut merging 2008, section 3.4]. For lights, the
/// visibility from clusters of vertices; see `visibility_vectors`.
///
/// The metric is (1 - beta) x differences of vectors + beta x the geometric one [Eq. 12], the former scaled at each
/// split so that both have the same mean over the set: the constant in print [Eq. 11] makes it vanish beside the other.
class DataDriven {
public:
    /// `vectors`: of item i the `length` numbers from i x length on; referred to. `beta`: 0 ignores geometry, 1 all but
    /// geometry; where vectors are equal, of hidden lights say, geometry decides alone.
    /// throws: invalid_input if `vectors` is no multiple of `length`, naming a number of them that is not finite, if
    /// `beta` is not in [0, 1], or as `TwoCenters::check`. cost: O(vectors).
    DataDriven(std::span<const float> vectors, std::size_t length, double beta = 0.45, const TwoCenters& geometric = {})
        : vectors_(vectors), length_(length), beta_(beta), geometric_(geometric) {
        if (length == 0 || vectors.size() % length != 0) {
            LIGHTCUTS_THROW(invalid_input("data-driven splits: " + std::to_string(vectors.size()) +
                                          " numbers are no vectors of " + std::to_string(length)));
        }
        if (!(beta >= 0.0 && beta <= 1.0)) {
            LIGHTCUTS_THROW(invalid_input("data-driven splits: beta " + std::to_string(beta) + " is not in 0 to 1"));
        }
        geometric.check();
        for (std::size_t i = 0; i < vectors.size(); ++i) {
            if (!std::isfinite(vectors[i])) {
                LIGHTCUTS_THROW(invalid_input("data-driven splits: item " + std::to_string(i / length) + ", number " +
                                              std::to_string(i % length) + " is not finite"));
            }
        }
    }
    DataDriven(std::vector<float>&&, std::size_t, double = 0.45, const TwoCenters& = {}) = delete;

    /// See `Splitter`; allocates as `TwoCenters`, and a vector a center. pre: there is a vector for each item. cost:
    /// O(items x iterations x length).
    template <std::size_t Dimensions>
    Split<Dimensions> split(const BuildRange<Dimensions>& range, const NormalizedSpace&) const {
        detail::VectorMetric<Dimensions> metric{
            {geometric_.position_factor * geometric_.position_factor}, vectors_, length_};
        const auto center = metric.mean(range.items);
        double geometric = 0.0, vector = 0.0;
        for (const BuildItem<Dimensions>& i : range.items) {
            geometric += metric.geometric.distance(i, center.geometric);
            vector += metric.vector_distance(i, center);
        }
        if (vector > 0.0 && geometric > 0.0) {
            metric.geometric_weight = beta_;
            metric.vector_weight = (1.0 - beta_) * (geometric / vector);
        }
        return detail::split_by_two_centers(range, geometric_.iterations, metric);
    }

private:
    std::span<const float> vectors_;
    std::size_t length_;
    double beta_;
    TwoCenters geometric_;
};

}  // namespace lightcuts
