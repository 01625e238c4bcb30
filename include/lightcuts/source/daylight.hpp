#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <glm/vec3.hpp>

namespace lightcuts::detail {

/// What an eye sees of a spectrum, given at 380, 390, ... 750 nm.
using DaylightSpectrum = std::array<double, 38>;

inline constexpr double wavelength_of(std::size_t band) { return 380.0 + 10.0 * static_cast<double>(band); }

/// Radiance of the sun outside the atmosphere, W/(m^2 sr nm) / 100 [Preetham et al. 1999, table 2].
inline constexpr DaylightSpectrum sun_spectrum = {165.5, 162.3, 211.2, 258.8, 258.2, 242.3, 267.6, 296.6, 305.4, 300.6,
                                                  306.6, 288.3, 287.1, 278.2, 271.0, 272.3, 263.6, 255.0, 250.6, 253.1,
                                                  253.5, 251.3, 246.3, 241.7, 236.8, 232.1, 228.2, 223.4, 219.7, 215.3,
                                                  211.0, 207.3, 202.4, 198.7, 194.3, 190.7, 186.3, 182.6};

/// Absorption of ozone, 1/cm [table 2].
inline constexpr DaylightSpectrum ozone_absorption = {
    0.0,   0.0,   0.0,   0.0,   0.0,   0.0,   0.003, 0.003, 0.006, 0.009, 0.014, 0.021, 0.030,
    0.040, 0.048, 0.063, 0.075, 0.085, 0.103, 0.120, 0.120, 0.115, 0.125, 0.120, 0.105, 0.090,
    0.079, 0.067, 0.057, 0.048, 0.036, 0.028, 0.023, 0.018, 0.014, 0.011, 0.010, 0.009};

/// CIE 1931 color matching functions [fits by Wyman, Sloan and Shirley 2013]. `wavelength`: nm
inline glm::dvec3 color_matching(double wavelength) {
    const auto lobe = [&](double height, double at, double below, double above) {
        const double x = (wavelength - at) / (wavelength < at ? below : above);
        return height * std::exp(-0.5 * x * x);
    };
    return {lobe(1.056, 599.8, 37.9, 31.0) + lobe(0.362, 442.0, 16.0, 26.7) + lobe(-0.065, 501.1, 20.4, 26.2),
            lobe(0.821, 568.8, 46.9, 40.5) + lobe(0.286, 530.9, 16.3, 31.1),
            lobe(1.217, 437.0, 11.8, 36.0) + lobe(0.681, 459.0, 26.0, 13.8)};
}

/// Linear Rec. 709 of a color, with channels that the display cannot show (negative ones) at 0.
inline glm::dvec3 rgb_of_xyz(const glm::dvec3& xyz) {
    const auto shown = [](double c) { return c > 0.0 ? c : 0.0; };
    return {shown(3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z),
            shown(-0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z),
            shown(0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z)};
}

/// Luminance, cd/m^2 in linear Rec. 709, of the sun's disc seen through the atmosphere [Preetham et al. 1999,
/// appendix 1]: Rayleigh scattering, aerosols of the given turbidity, ozone. Water vapour and mixed gases absorb beyond
/// 690 nm, where the eye sees a thousandth; they are left out.
/// `zenith_angle`: radians, at most pi/2
inline glm::dvec3 sun_luminance(double zenith_angle, double turbidity) {
    const double degrees = zenith_angle * 180.0 / std::numbers::pi;
    const double mass = 1.0 / (std::cos(zenith_angle) + 0.15 * std::pow(93.885 - degrees, -1.253));
    const double aerosols = 0.04608365822050 * turbidity - 0.04586025928522;
    constexpr double ozone = 0.35;             // cm
    constexpr double lumens_per_watt = 683.0;  // at the eye's maximum
    glm::dvec3 xyz(0.0);
    for (std::size_t i = 0; i < sun_spectrum.size(); ++i) {
        const double micrometers = 1e-3 * wavelength_of(i);
        const double depth = 0.008735 * std::pow(micrometers, -4.08) + aerosols * std::pow(micrometers, -1.3) +
                             ozone_absorption[i] * ozone;
        const double radiance = 100.0 * sun_spectrum[i] * std::exp(-mass * depth);
        xyz += color_matching(wavelength_of(i)) * (radiance * 10.0 * lumens_per_watt);
    }
    return rgb_of_xyz(xyz);
}

/// Perez' five-parameter luminance distribution of a sky, up to a factor.
struct PerezSky {
    double a, b, c, d, e;

    /// `cos_zenith`: of the direction seen, > 0; `to_sun`: the angle between it and the sun.
    double operator()(double cos_zenith, double to_sun) const {
        const double cosine = std::cos(to_sun);
        return (1.0 + a * std::exp(b / cos_zenith)) * (1.0 + c * std::exp(d * to_sun) + e * cosine * cosine);
    }
};

/// Luminance and chromaticity of a clear sky [Preetham et al. 1999, appendix 2].
class PreethamSky {
public:
    /// `zenith_angle`: of the sun, radians, at most pi/2
    PreethamSky(double zenith_angle, double t)
        : luminance_{0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                     -0.0670 * t + 0.3703},
          x_{-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989,
             -0.0033 * t + 0.0452},
          y_{-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537,
             -0.0109 * t + 0.0529} {
        const double s = zenith_angle, s2 = s * s, s3 = s2 * s;
        const double chi = (4.0 / 9.0 - t / 120.0) * (std::numbers::pi - 2.0 * s);
        const double candela = 1000.0 * ((4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192);
        const double zenith_x = t * t * (0.00166 * s3 - 0.00375 * s2 + 0.00209 * s) +
                                t * (-0.02903 * s3 + 0.06377 * s2 - 0.03202 * s + 0.00394) +
                                (0.11693 * s3 - 0.21196 * s2 + 0.06052 * s + 0.25886);
        const double zenith_y = t * t * (0.00275 * s3 - 0.00610 * s2 + 0.00317 * s) +
                                t * (-0.04214 * s3 + 0.08970 * s2 - 0.04153 * s + 0.00516) +
                                (0.15346 * s3 - 0.26756 * s2 + 0.06670 * s + 0.26688);
        at_zenith_ = {candela / luminance_(1.0, s), zenith_x / x_(1.0, s), zenith_y / y_(1.0, s)};
    }

    /// Luminance, cd/m^2 in linear Rec. 709. `cos_zenith`: > 0
    glm::dvec3 rgb(double cos_zenith, double to_sun) const {
        const double luminance = at_zenith_.x * luminance_(cos_zenith, to_sun);
        const double x = at_zenith_.y * x_(cos_zenith, to_sun), y = at_zenith_.z * y_(cos_zenith, to_sun);
        return rgb_of_xyz({luminance * x / y, luminance, luminance * (1.0 - x - y) / y});
    }

private:
    PerezSky luminance_, x_, y_;
    glm::dvec3 at_zenith_{0.0};
};

}  // namespace lightcuts::detail
