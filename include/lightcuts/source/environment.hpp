#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "../core/invalid_input.hpp"
#include "../light/directional.hpp"
#include "equal_power_strata.hpp"
#include "spherical_order.hpp"

namespace lightcuts {

/// Where radiance comes from: `pixels(x, y)` is called with a pixel's column and row, from the left and from the top,
/// and returns a spectrum.
template <class P>
concept PixelSource = std::invocable<const P&, std::uint32_t, std::uint32_t> &&
    Spectrum<std::remove_cvref_t<std::invoke_result_t<const P&, std::uint32_t, std::uint32_t>>>;

/// A latitude-longitude map of radiance around the scene; a view of the user's pixels.
///
/// +y is up. Longitude runs from +pi at the map's left edge to -pi at its right edge (edges, not pixels' centers),
/// latitude from pi/2 at the upper edge to -pi/2 at the lower one, and the direction towards a point of the map is
/// (sin lon cos lat, sin lat, cos lon cos lat): the center of the map looks along +z.
template <PixelSource Pixels>
struct EnvironmentMap {
    using spectrum = std::remove_cvref_t<std::invoke_result_t<const Pixels&, std::uint32_t, std::uint32_t>>;

    constexpr EnvironmentMap(std::uint32_t columns, std::uint32_t rows, Pixels source, float radiance_scale = 1.0f,
                             float degrees = 0.0f)
        : width(columns), height(rows), pixels(std::move(source)), scale(radiance_scale), rotation(degrees) {}

    std::uint32_t width;
    std::uint32_t height;
    Pixels pixels;
    float scale;     ///< of the radiance
    float rotation;  ///< degrees, counter-clockwise about +y seen from above

    /// Unit direction towards the point (x, y) of the map, in pixels from its upper left corner.
    glm::dvec3 direction_at(const glm::dvec2& point) const {
        const double longitude = std::numbers::pi * (1.0 - 2.0 * point.x / width) + turn();
        const double latitude = std::numbers::pi * (0.5 - point.y / height);
        return {std::sin(longitude) * std::cos(latitude), std::sin(latitude), std::cos(longitude) * std::cos(latitude)};
    }

    /// The point of the map, in pixels from its upper left corner, that lies in `direction`, a unit vector.
    /// Its x is in [0, width], its y in [0, height].
    glm::dvec2 point_at(const glm::dvec3& direction) const {
        const double sine = direction.y < -1.0 ? -1.0 : direction.y > 1.0 ? 1.0 : direction.y;
        const double turns = 0.5 - (std::atan2(direction.x, direction.z) - turn()) / (2.0 * std::numbers::pi);
        return {(turns - std::floor(turns)) * width, (0.5 - std::asin(sine) / std::numbers::pi) * height};
    }

    /// The radiance that arrives from `direction`, a unit vector: its pixel's.
    spectrum radiance(const glm::dvec3& direction) const {
        const auto below = [](double c, std::uint32_t end) {
            const auto cell = static_cast<std::uint32_t>(c);
            return cell < end ? cell : end - 1;
        };
        const glm::dvec2 p = point_at(direction);
        return spectrum(pixels(below(p.x, width), below(p.y, height)) * scale);
    }

    /// Solid angle of each pixel of row `y`.
    double solid_angle(std::uint32_t y) const {
        const auto edge = [&](double row) { return std::cos(std::numbers::pi * row / height); };
        return 2.0 * std::numbers::pi / width * (edge(y) - edge(y + 1.0));
    }

private:
    double turn() const { return static_cast<double>(rotation) * std::numbers::pi / 180.0; }
};

/// Pixels stored row by row from the top, `width` of them a row: a `PixelSource`.
template <class T>
struct RowMajorPixels {
    const T* first;
    std::uint32_t width;

    const T& operator()(std::uint32_t x, std::uint32_t y) const { return first[std::size_t{y} * width + x]; }
};

namespace detail {

/// The power (radiance x solid angle, sum of channels) of a map. throws: as `environment_lights`.
template <class Pixels>
double validated_power(const EnvironmentMap<Pixels>& map) {
    if (map.height == 0 || map.width != 2 * std::uint64_t{map.height}) {
        LIGHTCUTS_THROW(invalid_input("environment map: " + std::to_string(map.width) + " x " +
                                      std::to_string(map.height) +
                                      " pixels are not twice as wide as high, so this is no latitude-longitude map"));
    }
    if (!(map.scale > 0.0f && map.scale - map.scale == 0.0f && map.rotation - map.rotation == 0.0f)) {
        LIGHTCUTS_THROW(invalid_input("environment map: scale " + std::to_string(map.scale) + " or rotation " +
                                      std::to_string(map.rotation) + " is not finite, or the scale is not positive"));
    }
    double total = 0.0;
    for (std::uint32_t y = 0; y < map.height; ++y) {
        double row = 0.0;
        for (std::uint32_t x = 0; x < map.width; ++x) {
            const auto radiance = map.pixels(x, y);
            for (int i = 0; i < channels_of<typename EnvironmentMap<Pixels>::spectrum>; ++i) {
                const float c = channel(radiance, i);
                if (!(c >= 0.0f && c - c == 0.0f)) {
                    LIGHTCUTS_THROW(invalid_input("environment map, pixel (" + std::to_string(x) + ", " +
                                                  std::to_string(y) + "): radiance " + std::to_string(c) +
                                                  (c < 0.0f ? " is negative" : " is not finite")));
                }
            }
            row += channel_sum(radiance);
        }
        total += row * map.solid_angle(y);
    }
    total *= static_cast<double>(map.scale);
    if (!(total > 0.0)) LIGHTCUTS_THROW(invalid_input("environment map: all pixels are black"));
    return total;
}

}  // namespace detail

/// `count` distant lights that stand for a map: the sphere of directions is cut into `count` compact regions of equal
/// power (radiance x solid angle, sum of channels), and each becomes one light in a direction within its region: the
/// middle of its power, or drawn in proportion to power (`sampler`: `ScrambledSobol`). Where the map is bright, as in
/// the sun, the lights are close: a part of the map of n lights' power gets n lights within two for each time that the
/// curve through the regions leaves it, and even a single pixel can hold many. The irradiance of all lights together is
/// the map's, channel by channel.
///
/// The regions are consecutive along a curve: importance-driven strata in the spirit of structured importance sampling
/// [Agarwal et al. 2003], but all of one power.
/// throws: invalid_input if the map is not twice as wide as high, if a pixel is negative, infinite or NaN (the message
/// names it), or if all are black. cost: O(pixels + count); every pixel is read twice.
template <class Pixels, Sampler Sequence = CenteredSobol>
auto environment_lights(const EnvironmentMap<Pixels>& map, std::size_t count, const Sequence& sampler = {}) {
    using S = typename EnvironmentMap<Pixels>::spectrum;
    const double power = detail::validated_power(map);
    std::vector<DistantLight<S>> lights;
    if (count == 0) return lights;

    std::vector<double> angles(map.height);
    for (std::uint32_t y = 0; y < map.height; ++y) angles[y] = map.solid_angle(y) * static_cast<double>(map.scale);
    using Pixel = glm::uvec2;
    detail::EqualPowerStrata<Pixel, S, Sequence> regions(power, count, sampler);
    detail::visit_in_spherical_order(map.width, map.height, [&](std::uint32_t x, std::uint32_t y) {
        const S radiance = map.pixels(x, y);
        regions.add({x, y}, channel_sum(radiance) * angles[y], radiance, angles[y]);
    });

    lights.reserve(count);
    for (const auto& region : regions.finish()) {
        const double across = static_cast<double>(sampler(static_cast<std::uint32_t>(lights.size()), 1));
        const glm::dvec2 inside(region.fraction, across);
        const glm::dvec3 towards = map.direction_at(glm::dvec2(region.piece) + inside);
        lights.push_back({glm::vec3(-towards), region.power});
    }
    return lights;
}

}  // namespace lightcuts
