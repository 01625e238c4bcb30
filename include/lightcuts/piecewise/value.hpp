#pragma once

#include <concepts>

#include "../core/spectrum.hpp"

namespace lightcuts {

/// A value of a function on a tree: `float`, `double`, or several channels of float in any type that is a `Spectrum`,
/// whether it stands for light or not.
template <class V>
concept PiecewiseValue = Spectrum<V>;

/// Channel i of `v`, exactly; of a `double` all its digits.
template <PiecewiseValue V>
constexpr double value_channel(const V& v, int i) {
    if constexpr (std::floating_point<V>) {
        return static_cast<double>(v);
    } else {
        return static_cast<double>(channel(v, i));
    }
}

/// The value whose channel i is nearest to `f(i)`, a double.
template <PiecewiseValue V, std::invocable<int> F>
constexpr V make_value(F&& f) {
    if constexpr (std::floating_point<V>) {
        return static_cast<V>(f(0));
    } else {
        return make_spectrum<V>(f);
    }
}

}  // namespace lightcuts
