#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace lightcuts::detail {

/// Calls `f(k)` with k the std::integral_constant whose value is `kind`, and returns its result: for lists of types
/// that are fixed at compile time, of which one is chosen at run time. pre: kind < Count
template <std::size_t Count, std::size_t K = 0, class F>
constexpr decltype(auto) visit_kind([[maybe_unused]] std::uint32_t kind, const F& f) {
    using Constant = std::integral_constant<std::size_t, K>;
    if constexpr (K + 1 == Count) {
        return f(Constant{});
    } else {
        return kind == K ? f(Constant{}) : visit_kind<Count, K + 1>(kind, f);
    }
}

/// Calls `f(k)` for each std::integral_constant from 0 to Count - 1, in order.
template <std::size_t Count, std::size_t K = 0, class F>
constexpr void for_each_kind(const F& f) {
    f(std::integral_constant<std::size_t, K>{});
    if constexpr (K + 1 < Count) for_each_kind<Count, K + 1>(f);
}

}  // namespace lightcuts::detail
