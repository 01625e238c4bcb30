#pragma once

#include <cstdint>

namespace lightcuts {

/// Mixes 64 bits so that every input bit flips each output bit with a probability near one half (the finalizer of
/// SplitMix64). Bijective.
constexpr std::uint64_t mix_bits(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// Hash of a key of integers: the library's only source of random bits. A choice depends on what it is for
/// (seed, pixel, sample, kind, node), never on the order of calls, so images do not depend on threads.
template <class... Keys>
constexpr std::uint64_t hash_keys(std::uint64_t seed, Keys... keys) {
    std::uint64_t h = mix_bits(seed);
    ((h = mix_bits(h ^ static_cast<std::uint64_t>(keys))), ...);
    return h;
}

/// The upper 53 bits of `h` as a number in [0, 1).
constexpr double uniform01(std::uint64_t h) { return static_cast<double>(h >> 11) * 0x1p-53; }

}  // namespace lightcuts
