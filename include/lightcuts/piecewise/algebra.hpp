#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "../core/invalid_input.hpp"
#include "merge.hpp"
#include "piecewise_constant.hpp"

namespace lightcuts {

namespace detail {

/// What `op` makes of the functions' values.
template <class Op, class... F>
using result_over = std::remove_cvref_t<std::invoke_result_t<Op&, const piecewise_value_of<F>&...>>;

/// Where `op` can be called with the functions' values, its result can be added up.
template <class Op, class... F>
concept SummedOp = !std::invocable<Op&, const piecewise_value_of<F>&...> || PiecewiseValue<result_over<Op, F...>>;

/// A sum of values times numbers of leaves, in double.
template <PiecewiseValue V>
class LeafSum {
public:
    void add(std::uint32_t leaves, const V& value) {
        for (int c = 0; c < channels_of<V>; ++c) {
            sum_[static_cast<std::size_t>(c)] += static_cast<double>(leaves) * value_channel(value, c);
        }
    }
    /// A `double` for scalars, else a V.
    auto result() const {
        if constexpr (std::floating_point<V>) {
            return sum_[0];
        } else {
            return make_value<V>([this](int c) { return sum_[static_cast<std::size_t>(c)]; });
        }
    }

private:
    std::array<double, static_cast<std::size_t>(channels_of<V>)> sum_{};
};

/// Scalars alone are multiplied in double.
template <class A, class... B>
constexpr auto product_of(const A& a, const B&... b) {
    if constexpr ((std::floating_point<A> && ... && std::floating_point<B>)) {
        return (static_cast<double>(a) * ... * static_cast<double>(b));
    } else {
        return (a * ... * b);
    }
}
template <class A, class... B>
constexpr auto sum_of(const A& a, const B&... b) {
    return (a + ... + b);
}

}  // namespace detail

/// The sum over the leaves of op(values of the functions), a `PiecewiseValue`: a `double` where that is a scalar, else
/// one value. Added up in double. Multiply by what one leaf stands for, a solid angle or an area, to have an integral.
/// pre, throws, cost: as `merge`.
template <class Op, PiecewiseFunction... F>
    requires(sizeof...(F) >= 1)
&&detail::SummedOp<Op, F...> auto sum_over_leaves(Op&& op, const F&... functions) {
    static_assert(std::invocable<Op&, const piecewise_value_of<F>&...>,
                  "sum_over_leaves calls op(a value of each function): take as many values as functions");
    detail::LeafSum<detail::result_over<Op, F...>> sum;
    merge([&](std::uint32_t, std::uint32_t leaves, const auto&... values) { sum.add(leaves, op(values...)); },
          functions...);
    return sum.result();
}

/// The sum over the leaves of the product of the functions [Cut merging 2008, section 3.2]. Its error is bounded by
/// `bounded_product`. pre, throws, cost: as `merge`.
template <class... F>
    requires(sizeof...(F) >= 1)
auto sum_of_products(const F&... functions) {
    detail::require_functions<F...>();
    return sum_over_leaves([](const auto&... values) { return detail::product_of(values...); }, functions...);
}

/// Makes `out` the product of the functions. pre, throws, cost: as `merged`.
template <class V, class... F>
void product(PiecewiseConstant<V>& out, const F&... functions) {
    detail::require_functions<F...>();
    merged(
        out, [](const auto&... values) { return static_cast<V>(detail::product_of(values...)); }, functions...);
}

/// Makes `out` the sum of the functions. pre, throws, cost: as `merged`.
template <class V, class... F>
void sum(PiecewiseConstant<V>& out, const F&... functions) {
    detail::require_functions<F...>();
    merged(
        out, [](const auto&... values) { return static_cast<V>(detail::sum_of(values...)); }, functions...);
}

/// Makes `out` the sum of weight[i] x function[i], as over a triangle with barycentric weights
/// [Cut merging 2008, section 3.2]. pre: as `merge`; `out` is none of the functions. throws: invalid_input if there is
/// not one finite weight a function; as `merge`. cost: as `merge`.
template <PiecewiseValue V, PiecewiseFunction F>
    requires std::same_as<piecewise_value_of<F>, V>
void interpolate(PiecewiseConstant<V>& out, std::span<const float> weights, std::span<const F> functions,
                 MergeScratch<piecewise_value_of<F>>& scratch) {
    if (weights.size() != functions.size()) {
        LIGHTCUTS_THROW(invalid_input("interpolate: " + std::to_string(weights.size()) + " weights for " +
                                      std::to_string(functions.size()) + " functions"));
    }
    for (std::size_t i = 0; i < weights.size(); ++i) {
        if (!std::isfinite(weights[i])) {
            LIGHTCUTS_THROW(invalid_input("interpolate: weight " + std::to_string(i) + " is not finite"));
        }
    }
    detail::Filling filling(out);
    std::uint32_t end = 0;
    merge(functions, scratch, [&](std::uint32_t node, std::uint32_t leaves, std::span<const V> values) {
        V total = values[0] * weights[0];
        for (std::size_t i = 1; i < values.size(); ++i) total = total + values[i] * weights[i];
        end += leaves;
        out.append({node, end}, total);
    });
    filling.finish();
}

}  // namespace lightcuts
