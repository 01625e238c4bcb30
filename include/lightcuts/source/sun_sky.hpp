#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "../core/invalid_input.hpp"
#include "../light/directional.hpp"
#include "daylight.hpp"
#include "environment.hpp"

namespace lightcuts {

/// Where the sun stands, and how hazy the air is: what a SunSky is made of.
struct SunPosition {
    double elevation = 45.0;  ///< degrees above the horizon, 0 to 90
    double azimuth = 0.0;     ///< degrees from +z towards +x; +y is up
    double turbidity = 3.0;   ///< 2 (very clear) to 10 (hazy)
};

/// A clear sky with a sun [Preetham, Shirley and Smits 1999, A practical analytic model for daylight] over level,
/// diffuse ground, which they light.
///
/// Radiances are linear Rec. 709, W/(m^2 sr): the model's luminance divided by one luminous efficacy, 179 lm/W, that
/// of the pictures of the renderer Radiance. Sun and sky keep their ratio, and their sum is about that of daylight.
/// +y is up. Immutable; safe to share between threads.
class SunSky {
public:
    /// The sky of a sun at `position`. `ground_albedo`: the share of light that the ground reflects, in each channel
    /// from 0 to 1; with 0 everything below the horizon is black.
    /// throws: invalid_input if the elevation is not in [0, 90] degrees (the model ends at the horizon), the azimuth is
    /// not finite, the turbidity is not in [2, 10] or the albedo not in [0, 1].
    /// cost: a millisecond for ground that is not black, else microseconds.
    explicit SunSky(const SunPosition& position, const glm::vec3& ground_albedo = glm::vec3(0.0f))
        : towards_sun_(direction_of(position)), sky_(zenith_angle(position), position.turbidity),
          sun_(glm::vec3(detail::sun_luminance(zenith_angle(position), position.turbidity) / efficacy)) {
        for (int c = 0; c < 3; ++c) {
            if (!(ground_albedo[c] >= 0.0f && ground_albedo[c] <= 1.0f)) {
                LIGHTCUTS_THROW(
                    invalid_input("ground: albedo " + std::to_string(ground_albedo[c]) + " is not in 0 to 1"));
            }
        }
        if (ground_albedo != glm::vec3(0.0f)) {
            const glm::vec3 irradiance = sun_irradiance() * static_cast<float>(towards_sun_.y) + sky_irradiance();
            ground_ = ground_albedo * std::numbers::inv_pi_v<float> * irradiance;
        }
    }

    /// The unit vector towards the center of the sun's disc.
    const glm::dvec3& towards_sun() const { return towards_sun_; }
    /// The radiance of the sun's disc, W/(m^2 sr), without the sky in front of it; the same all over the disc.
    const glm::vec3& sun_radiance() const { return sun_; }
    /// The irradiance that the sun's disc alone causes on a plane that faces it, W/m^2.
    glm::vec3 sun_irradiance() const { return sun_ * static_cast<float>(sun_solid_angle); }
    /// The radiance of the sky in `direction`, W/(m^2 sr), without the sun's disc; black at and below the horizon.
    /// pre: `direction` is a unit vector
    glm::vec3 sky_radiance(const glm::dvec3& direction) const {
        if (!(direction.y > 0.0)) return glm::vec3(0.0f);
        const double cosine = glm::dot(direction, towards_sun_);
        const double to_sun = std::acos(cosine < -1.0 ? -1.0 : cosine > 1.0 ? 1.0 : cosine);
        return glm::vec3(sky_.rgb(direction.y, to_sun) / efficacy);
    }
    /// The irradiance that the sky without the sun's disc causes on a level plane, W/m^2, accurate to 1e-4.
    /// cost: that of 16,384 calls of sky_radiance
    glm::vec3 sky_irradiance() const {
        constexpr int rings = 128, steps = 128;
        const double azimuth = std::atan2(towards_sun_.x, towards_sun_.z);
        glm::dvec3 sum(0.0);
        double last_sine2 = 0.0;
        for (int i = 0; i < rings; ++i) {
            const double up = std::numbers::pi / 2 * (i + 0.5) / rings;
            const double sine = std::sin(std::numbers::pi / 2 * (i + 1) / rings), sine2 = sine * sine;
            glm::dvec3 ring(0.0);
            for (int j = 0; j < steps; ++j) {  // half a circle: the other mirrors it
                const double around = azimuth + std::numbers::pi * (j + 0.5) / steps;
                ring += glm::dvec3(
                    sky_radiance({std::sin(around) * std::cos(up), std::sin(up), std::cos(around) * std::cos(up)}));
            }
            sum += ring * (sine2 - last_sine2);
            last_sine2 = sine2;
        }
        return glm::vec3(sum * (std::numbers::pi / steps));
    }
    /// The radiance of the ground, W/(m^2 sr): albedo / pi x the irradiance of sun and sky on a level plane. The same
    /// in all directions below the horizon.
    const glm::vec3& ground_radiance() const { return ground_; }
    /// The radiance that arrives from `direction`, W/(m^2 sr): of the ground at and below the horizon, above it of the
    /// sky, to which that of the sun is added within its disc. pre: `direction` is a unit vector
    glm::vec3 radiance(const glm::dvec3& direction) const {
        if (!(direction.y > 0.0)) return ground_;
        const bool on_disc = glm::dot(direction, towards_sun_) > std::cos(sun_radius);
        return on_disc ? sky_radiance(direction) + sun_ : sky_radiance(direction);
    }

    /// Luminous efficacy, lm/W: what the model's luminance is divided by.
    static constexpr double efficacy = 179.0;
    /// Angle between the center and the edge of the sun's disc, radians.
    static constexpr double sun_radius = 0.2665 * std::numbers::pi / 180;
    /// Solid angle of the sun's disc, sr.
    static constexpr double sun_solid_angle = std::numbers::pi * sun_radius * sun_radius *
                                              (1.0 - sun_radius * sun_radius / 12.0);

private:
    static double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }
    static double zenith_angle(const SunPosition& p) { return radians(90.0 - p.elevation); }
    static glm::dvec3 direction_of(const SunPosition& p) {
        if (!(p.elevation >= 0.0 && p.elevation <= 90.0)) {
            LIGHTCUTS_THROW(invalid_input("sun: elevation " + std::to_string(p.elevation) +
                                          " is not in 0 to 90 degrees; the sky's model ends at the horizon"));
        }
        if (!(p.azimuth - p.azimuth == 0.0)) LIGHTCUTS_THROW(invalid_input("sun: the azimuth is not finite"));
        if (!(p.turbidity >= 2.0 && p.turbidity <= 10.0)) {
            LIGHTCUTS_THROW(invalid_input("sky: turbidity " + std::to_string(p.turbidity) + " is not in 2 to 10"));
        }
        const double up = radians(p.elevation), around = radians(p.azimuth);
        return {std::sin(around) * std::cos(up), std::sin(up), std::cos(around) * std::cos(up)};
    }

    glm::dvec3 towards_sun_;
    detail::PreethamSky sky_;
    glm::vec3 sun_;
    glm::vec3 ground_{0.0f};
};

/// `count` distant lights of equal irradiance whose directions are spread over the sun's disc with uniform density.
/// Their irradiances, W/m^2 on planes that face them, add up to `daylight.sun_irradiance()`. cost: O(count)
template <Sampler Sequence = ScrambledSobol>
std::vector<DistantLight<>> sun_lights(const SunSky& daylight, std::size_t count = 64, const Sequence& sampler = {}) {
    const glm::dvec3 axis = daylight.towards_sun();
    const glm::dvec3 aside = std::fabs(axis.y) < 0.9 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 x = glm::normalize(glm::cross(aside, axis)), y = glm::cross(axis, x);
    const glm::vec3 share(glm::dvec3(daylight.sun_irradiance()) / static_cast<double>(count));
    std::vector<DistantLight<>> lights;
    lights.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const double radius = std::sqrt(static_cast<double>(sampler(i, 0))) * std::tan(SunSky::sun_radius);
        const double turn = 2.0 * std::numbers::pi * static_cast<double>(sampler(i, 1));
        const glm::dvec3 towards = axis + radius * (std::cos(turn) * x + std::sin(turn) * y);
        lights.push_back({glm::vec3(-glm::normalize(towards)), share});
    }
    return lights;
}

/// `count` distant lights of equal power (sum of channels) that stand for the sky without the sun's disc. The sky is
/// evaluated at the pixels of a latitude-longitude map of 2 `rows` x `rows`, whose sphere is cut into `count` compact
/// regions of equal power; each becomes one light within its region (`environment_lights`). Together they have the
/// irradiance of that map, W/m^2, channel by channel.
/// throws: invalid_input if `rows` is 0. cost: O(rows^2 + count), and 12 bytes of temporary memory a pixel
template <Sampler Sequence = CenteredSobol>
std::vector<DistantLight<>> sky_lights(const SunSky& daylight, std::size_t count, std::uint32_t rows = 256,
                                       const Sequence& sampler = {}) {
    std::vector<glm::vec3> pixels;
    pixels.reserve(std::size_t{2} * rows * rows);
    // Only where the pixels are: those lie in EnvironmentMap's own places.
    const EnvironmentMap places(2 * rows, rows, [](std::uint32_t, std::uint32_t) { return 1.0f; });
    for (std::uint32_t y = 0; y < rows; ++y) {
        for (std::uint32_t x = 0; x < 2 * rows; ++x) {
            pixels.push_back(daylight.sky_radiance(places.direction_at({x + 0.5, y + 0.5})));
        }
    }
    const RowMajorPixels<glm::vec3> source{pixels.data(), 2 * rows};
    return environment_lights(EnvironmentMap(2 * rows, rows, source), count, sampler);
}

/// `count` distant lights of equal irradiance that stand for the ground: their light comes from below the horizon, out
/// of directions on a spiral that covers the lower hemisphere with uniform density. Their irradiance on a level plane
/// that looks down is exactly pi x `daylight.ground_radiance()`, W/m^2. Black ground makes black lights, which trees
/// leave out. cost: O(count)
template <Sampler Sequence = CenteredSobol>
std::vector<DistantLight<>> ground_lights(const SunSky& daylight, std::size_t count, const Sequence& sampler = {}) {
    const double golden_turn = 2.0 * std::numbers::pi * (2.0 - std::numbers::phi);
    const double start = 2.0 * std::numbers::pi * static_cast<double>(sampler(0, 1));
    const auto n = static_cast<double>(count);
    const glm::vec3 share(glm::dvec3(daylight.ground_radiance()) * (2.0 * std::numbers::pi / n));
    std::vector<DistantLight<>> lights;
    lights.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double down = (static_cast<double>(i) + 0.5) / n, out = std::sqrt(1.0 - down * down);
        const double turn = start + golden_turn * static_cast<double>(i);
        lights.push_back({glm::vec3(-out * std::sin(turn), down, -out * std::cos(turn)), share});
    }
    return lights;
}

}  // namespace lightcuts
