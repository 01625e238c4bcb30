#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>

#include "../core/random.hpp"

namespace lightcuts {

/// Where sources take their random numbers from: `sampler(index, dimension)` in [0, 1), always the same for the same
/// arguments. `index` counts lights or particles; dimensions 2k and 2k + 1 are used together.
template <class N>
concept Sampler = requires(const N& sampler, std::uint32_t index, std::uint32_t dimension) {
    { sampler(index, dimension) } -> std::convertible_to<double>;
};

namespace detail {

constexpr std::uint32_t reversed_bits(std::uint32_t x) {
    x = (x << 16) | (x >> 16);
    x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

/// Flips every bit of `x` by a hash of the bits below it [Laine and Karras 2011]: Owen's nested uniform scrambling of
/// the fraction whose bits are those of x, reversed.
constexpr std::uint32_t scrambled_upwards(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

/// Owen's nested uniform scrambling of the fraction x / 2^32: every bit is flipped by a hash of the bits above it.
constexpr std::uint32_t nested_scramble(std::uint32_t x, std::uint32_t seed) {
    return reversed_bits(scrambled_upwards(reversed_bits(x), seed));
}

/// Second coordinate of Sobol's sequence with its bits reversed; those of the first are the index itself. Bit j is the
/// sum, modulo 2, of the index's bits k times the binomial coefficients (k over j), which are odd where the bits of j
/// are among those of k.
constexpr std::uint32_t sobol_second_reversed(std::uint32_t index) {
    index ^= (index >> 16) & 0x0000ffffu;
    index ^= (index >> 8) & 0x00ff00ffu;
    index ^= (index >> 4) & 0x0f0f0f0fu;
    index ^= (index >> 2) & 0x33333333u;
    index ^= (index >> 1) & 0x55555555u;
    return index;
}

}  // namespace detail

/// Evenly spread numbers: each pair of dimensions is a copy of the first two dimensions of Sobol's sequence, scrambled
/// and shuffled on its own [Owen 1995; Kollig and Keller 2002], so that the first 2^k indices have one number in each
/// 2^k-th of every dimension. Over seeds, each number is uniform. cost: about 10 ns
struct ScrambledSobol {
    std::uint64_t seed = 0;

    constexpr double operator()(std::uint32_t index, std::uint32_t dimension) const {
        using namespace detail;
        const auto shuffle = static_cast<std::uint32_t>(hash_keys(seed, dimension / 2, 0));
        const auto scramble = static_cast<std::uint32_t>(hash_keys(seed, dimension, 1));
        const std::uint32_t at = nested_scramble(index, shuffle);
        const std::uint32_t x = dimension % 2 == 0 ? at : sobol_second_reversed(at);
        return static_cast<double>(reversed_bits(scrambled_upwards(x, scramble))) * 0x1p-32;
    }
};

/// Puts each light in the middle of its own share of the power (dimension 0 is always 1/2); the other dimensions are
/// `ScrambledSobol`. More even than random places where shares are irregular anyway, but the mean over seeds is no
/// longer that of the map or surface.
struct CenteredSobol {
    std::uint64_t seed = 0;

    constexpr double operator()(std::uint32_t index, std::uint32_t dimension) const {
        return dimension == 0 ? 0.5 : ScrambledSobol{seed}(index, dimension);
    }
};

/// Independent numbers: a hash of (seed, index, dimension).
struct IndependentSampler {
    std::uint64_t seed = 0;

    constexpr double operator()(std::uint32_t index, std::uint32_t dimension) const {
        return uniform01(hash_keys(seed, index, dimension));
    }
};

/// Not random: each light is near the middle of its own share of the power (dimension 0 is from 3/8 to 5/8), and
/// dimensions 2 and 3 are the additive recurrence of the plastic number from the middle of the square [Roberts 2018],
/// even for any count. Dimensions 0 and 1 are recurrences too; all others are `IndependentSampler`.
struct CenteredRecurrence {
    double operator()(std::uint32_t index, std::uint32_t dimension) const {
        constexpr double step0 = 0.8191725133961645;  // 1/x, x^4 = x + 1
        constexpr std::array starts{step0, 0.5, 0.5, 0.5};
        constexpr std::array steps{step0, 0.6180339887498949, 0.7548776662466927, 0.5698402909980532};
        if (dimension >= steps.size()) return IndependentSampler{}(index, dimension);
        const double turn = starts[dimension] + steps[dimension] * static_cast<double>(index);
        const double fraction = turn - std::floor(turn);
        // Not the middle itself: shares begin and end where pieces of a surface do, and so it often is a corner of one.
        return dimension == 0 ? 0.375 + 0.25 * fraction : fraction;
    }
};

}  // namespace lightcuts
