#pragma once

#include <cstdint>

/// Before functions that are loops over lanes. Where LIGHTCUTS_SEVERAL_TARGETS is defined, and g++ compiles for x86-64
/// processors without AVX2 and without fused multiply-adds, they are compiled a second time for AVX2, and which one
/// runs is decided when the program is loaded. Both give the same bits, since AVX2 alone contracts nothing. Not for
/// libraries that others load: the loader decides by indirect functions, which an executable and a shared library
/// cannot share where symbols are bound at once. Define it for all files of a program or for none.
#if defined(LIGHTCUTS_SEVERAL_TARGETS) && defined(__GNUC__) && __GNUC__ >= 12 && defined(__x86_64__) &&             \
    defined(__GLIBC__) && !defined(__clang__) && !defined(__EDG__) && !defined(__CUDACC__) && !defined(__AVX2__) && \
    !defined(__FMA__) && !defined(__FMA4__) && !defined(__SSP_ALL__) && !defined(__SANITIZE_ADDRESS__) &&           \
    !defined(__SANITIZE_THREAD__)
#define LIGHTCUTS_VECTORIZED [[gnu::target_clones("avx2", "default")]]
#else
#define LIGHTCUTS_VECTORIZED
#endif
