#pragma once

#include <concepts>
#include <cstddef>

namespace lightcuts {

/// Something that a builder tells how far it is: `progress(n)`, n more items are in place; in the end the n sum up to
/// the number of items. It may be called from several of the executor's threads at once and must not throw.
template <class P>
concept Progress = std::invocable<P&, std::size_t>;

/// The default: ignores it.
struct NoProgress {
    constexpr void operator()(std::size_t) const {}
};

}  // namespace lightcuts
