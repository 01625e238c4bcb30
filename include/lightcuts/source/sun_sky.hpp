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

/// Where the sun stands, and how hazy the air is.
struct SunPosition {
    double elevation = 45.0;  ///< degrees above the horizon, 0 to 90
    double azimuth = 0.0;     ///< degrees from +z towards +x; +y is up
    double turbidity = 3.0;   ///< 2 (very clear) to 10 (hazy)
};

/// A clear sky with a sun [Preetham, Shirley and Smits 1999, A practical analytic model for daylight] over level,
/// diffuse ground, which they light.
///
/// Radiances are linear Rec. 709, W/(m^2 sr): luminance / 179 lm/W, the efficacy that Radiance's pictures use too, so
/// that sun and sky keep their ratio and their sum is about what daylight carries.
class SunSky {
public:
    /// `ground_albedo`: of the ground, 0 to 1; 0: all is black below the horizon.
    /// throws: invalid_input if the sun is below the horizon (the model ends there), the turbidity not in [2, 10] or
    /// the albedo not in [0, 1]. cost: a millisecond, for ground that is not black.
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

    /// Unit.
    const glm::dvec3& towards_sun() const { return towards_sun_; }
    /// Of the sun's disc, the same all over it.
    const glm::vec3& sun_radiance() const { return sun_; }
    /// Irradiance on a plane that faces the sun, W/m^2, of the disc alone.
    glm::vec3 sun_irradiance() const { return sun_ * static_cast<float>(sun_solid_angle); }
    /// Of the sky in `direction`, a unit vector, without the sun's disc.
    glm::vec3 sky_radiance(const glm::dvec3& direction) const {
        if (!(direction.y > 0.0)) return glm::vec3(0.0f);
        const double cosine = glm::dot(direction, towards_sun_);
        const double to_sun = std::acos(cosine < -1.0 ? -1.0 : cosine > 1.0 ? 1.0 : cosine);
        return glm::vec3(sky_.rgb(direction.y, to_sun) / efficacy);
    }
    /// Irradiance on a level plane, W/m^2, of the sky without the sun's disc. Accurate to 1e-4.
    /// cost: 16,384 times sky_radiance
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
    /// Of the ground, the same in all directions below the horizon: albedo / pi x the irradiance of sun and sky on it.
    const glm::vec3& ground_radiance() const { return ground_; }
    /// What an eye sees in `direction`, a unit vector.
    glm::vec3 radiance(const glm::dvec3& direction) const {
        if (!(direction.y > 0.0)) return ground_;
        const bool on_disc = glm::dot(direction, towards_sun_) > std::cos(sun_radius);
        return on_disc ? sky_radiance(direction) + sun_ : sky_radiance(direction);
    }

    static constexpr double efficacy = 179.0;                              ///< lm/W
    static constexpr double sun_radius = 0.2665 * std::numbers::pi / 180;  ///< radians
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

/// `count` distant lights spread evenly over the sun's disc, of equal power; their irradiance is the sun's.
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

/// `count` distant lights of equal power that stand for the sky without the sun's disc: `environment_lights` of it,
/// at `rows` rows of latitude.
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

/// `count` distant lights of equal power that stand for the ground, from below the horizon. They are spread evenly, on
/// a spiral; on a plane that looks down their irradiance is exactly pi x the ground's radiance.
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
