#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

namespace lightcuts::test {

/// How often this program has allocated.
inline std::size_t allocations = 0;
/// The most bytes that one of them was for; set it to zero before you look.
inline std::size_t largest_allocation = 0;

}  // namespace lightcuts::test

// Replaces the operators of the whole program: for one file of it only. Those that may not throw, which the buffer of
// std::stable_sort comes from, are replaced too: a sanitizer's own would not match these ways to free.
// Not inlined, or GCC takes malloc's memory in one for a mismatch in the other.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    ++lightcuts::test::allocations;
    if (size > lightcuts::test::largest_allocation) lightcuts::test::largest_allocation = size;
    return std::malloc(size);
}
[[gnu::noinline]] void* operator new(std::size_t size) {
    if (void* p = operator new(size, std::nothrow)) return p;
    throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, const std::nothrow_t&) noexcept { std::free(p); }
