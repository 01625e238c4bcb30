#pragma once

namespace lightcuts::test {

/// Whether products and sums are contracted (LIGHTCUTS_FP_CONTRACT): then the same expression, compiled in two places,
/// may be rounded in two ways. Otherwise it may not.
#ifdef LIGHTCUTS_CONTRACTED
inline constexpr bool is_contracted = true;
#else
inline constexpr bool is_contracted = false;
#endif

}  // namespace lightcuts::test
