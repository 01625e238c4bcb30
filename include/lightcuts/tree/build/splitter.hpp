#pragma once

#include <concepts>
#include <cstddef>

#include "build_range.hpp"
#include "normalized_space.hpp"

namespace lightcuts {

/// A rule by which `divide` and `divide_into` halve sets of items of so many dimensions.
///
/// `split(range, space)` reorders `range.items`, at least 3, and returns its first items and the rest, neither empty;
/// `split_at` makes such a pair. Coordinates are those of `space`. It is called for several ranges at once if the
/// builder's executor has threads, and must not throw. A tree is the same on every run if the sets do not depend on the
/// order in which the items come.
///
/// Optional: `check()` throws invalid_input if options are bad; builders call it before they begin.
///
/// A splitter whose cuts are too uneven does not make a tree deep: below a depth of about 2 log2 N, `LongestAxis`
/// takes over. Models: `Binned`, `LongestAxis`, `TwoCenters`, `DataDriven`.
template <class S, std::size_t Dimensions>
concept Splitter = requires(const S& splitter, const BuildRange<Dimensions>& range, const NormalizedSpace& space) {
    { splitter.split(range, space) } -> std::same_as<Split<Dimensions>>;
};

}  // namespace lightcuts
