#include "shutter.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include <lightcuts/core/random.hpp>

namespace render {

namespace {

/// Of a Gaussian shutter from its middle to where it is cut off.
constexpr double deviations = 2.0;

/// The share of a Gaussian shutter's light that has come in at `time`.
double gaussian_share(double time) {
    const auto below = [](double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); };
    const double least = below(-deviations);
    return (below(deviations * (2.0 * time - 1.0)) - least) / (1.0 - 2.0 * least);
}

double gaussian_time(double share) {
    double low = 0.0;
    double high = 1.0;
    for (int step = 0; step < 60; ++step) {
        const double middle = 0.5 * (low + high);
        (gaussian_share(middle) < share ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// Place of `i` in an order of the numbers below `count` that depends on `seed`: rounds of an invertible mixing of the
/// bits, until it falls below `count`.
std::uint32_t shuffled(std::uint32_t i, std::uint32_t count, std::uint64_t seed) {
    if (count < 2) return 0;
    // Two halves of equal width for a balanced Feistel network.
    const int half = (std::bit_width(count - 1) + 1) / 2;
    const std::uint32_t mask = (1u << half) - 1;
    do {
        std::uint32_t left = i >> half;
        std::uint32_t right = i & mask;
        for (std::uint32_t round = 0; round < 4; ++round) {
            const auto mixed = static_cast<std::uint32_t>(lightcuts::hash_keys(seed, round, right)) & mask;
            const std::uint32_t next = left ^ mixed;
            left = right;
            right = next;
        }
        i = left << half | right;
    } while (i >= count);
    return i;
}

std::uint32_t instant_bits(std::size_t instants) {
    return static_cast<std::uint32_t>(std::bit_ceil(std::max<std::size_t>(instants, 1))) - 1;
}

}  // namespace

std::string name_of(ShutterShape shape) { return shape == ShutterShape::box ? "box" : "gaussian"; }

std::vector<float> times_of_instants(const Shutter& shutter) {
    std::vector<float> times(shutter.instants);
    for (std::size_t i = 0; i < times.size(); ++i) {
        const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(times.size());
        times[i] = static_cast<float>(shutter.shape == ShutterShape::box ? share : gaussian_time(share));
    }
    return times;
}

std::uint32_t instant_of_ray(std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample, std::uint32_t spp,
                             std::uint32_t instants) {
    if (instants < 2) return 0;
    // A pixel's own seed, apart from those of other choices of the pixel.
    constexpr std::uint32_t purpose = 0x696e7374u;
    const std::uint64_t own = lightcuts::hash_keys(seed, pixel, purpose);
    const std::uint32_t stratum = shuffled(sample, spp, own);
    const double within = lightcuts::uniform01(lightcuts::hash_keys(own, stratum));
    const double share = (static_cast<double>(stratum) + within) / static_cast<double>(spp);
    return std::min(static_cast<std::uint32_t>(share * static_cast<double>(instants)), instants - 1);
}

std::uint32_t name_with_instant(std::uint32_t name, std::uint32_t instant, std::size_t instants) {
    return (name & ~instant_bits(instants)) | instant;
}

std::uint32_t instant_in_name(std::uint32_t name, std::size_t instants) { return name & instant_bits(instants); }

}  // namespace render
