#pragma once

#include <cstdint>

/// Before functions that are loops over lanes: compiled a second time for AVX2, where g++ compiles for any x86-64
/// processor; which one runs is decided once, when the program is loaded. Both give the same bits, since AVX2 alone
/// contracts nothing. Define LIGHTCUTS_ONE_TARGET to compile for one only.
#if defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__) && defined(__x86_64__) && defined(__GLIBC__) && \
    !defined(__AVX2__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) &&                   \
    !defined(LIGHTCUTS_ONE_TARGET)
#define LIGHTCUTS_VECTORIZED [[gnu::target_clones("avx2", "default")]]
#else
#define LIGHTCUTS_VECTORIZED
#endif
