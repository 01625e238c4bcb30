#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace render {

/// How the light of a picture is spread over the time for which the shutter is open: evenly, or by a Gaussian about the
/// middle that is cut off at two standard deviations, as a shutter that takes time to open and to close.
enum class ShutterShape { gaussian, box };

/// As the command line calls it.
std::string name_of(ShutterShape shape);

/// When light is let in, on the scene's own clock.
struct Shutter {
    double opens = 0.0;    ///< seconds
    double seconds = 0.0;  ///< for which it is open; 0: a moment, in which nothing moves
    std::uint32_t instants = 1;
    ShutterShape shape = ShutterShape::gaussian;

    bool is_moment() const { return !(seconds > 0.0); }
    /// `time`: 0 as it opens, 1 as it closes.
    double second_at(double time) const { return opens + time * seconds; }
};

/// The times of a shutter's instants, ascending, from 0 as it opens to 1 as it closes: each stands for an equal share
/// of the light, and lies in the middle of it.
std::vector<float> times_of_instants(const Shutter& shutter);

/// The instant of eye ray `sample` of `spp` of a pixel: each pixel's rays are spread evenly over the instants, in an
/// order that is a hash of (seed, pixel). Where there are fewer rays than instants, any instant is taken equally often
/// by the pixels together. pre: sample < spp; instants > 0. cost: O(1)
std::uint32_t instant_of_ray(std::uint64_t seed, std::uint32_t pixel, std::uint32_t sample, std::uint32_t spp,
                             std::uint32_t instants);

/// `name` with the instant in its lowest bits, so that those who know a receiver by this number alone know its instant;
/// `name` itself if there is but one instant.
std::uint32_t name_with_instant(std::uint32_t name, std::uint32_t instant, std::size_t instants);

/// The instant in such a number.
std::uint32_t instant_in_name(std::uint32_t name, std::size_t instants);

}  // namespace render
