#include "cie_sky.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

#include <lightcuts/core/invalid_input.hpp>

namespace daylighting {
namespace {

/// [ISO 15469, table 1]
struct Parameters {
    double a, b, c, d, e;
};
constexpr std::array<Parameters, 15> general = {{
    {4.0, -0.70, 0.0, -1.0, 0.00},
    {4.0, -0.70, 2.0, -1.5, 0.15},
    {1.1, -0.80, 0.0, -1.0, 0.00},
    {1.1, -0.80, 2.0, -1.5, 0.15},
    {0.0, -1.00, 0.0, -1.0, 0.00},
    {0.0, -1.00, 2.0, -1.5, 0.15},
    {0.0, -1.00, 5.0, -2.5, 0.30},
    {0.0, -1.00, 10.0, -3.0, 0.45},
    {-1.0, -0.55, 2.0, -1.5, 0.15},
    {-1.0, -0.55, 5.0, -2.5, 0.30},
    {-1.0, -0.55, 10.0, -3.0, 0.45},
    {-1.0, -0.32, 10.0, -3.0, 0.45},
    {-1.0, -0.32, 16.0, -3.0, 0.30},
    {-1.0, -0.15, 16.0, -3.0, 0.30},
    {-1.0, -0.15, 24.0, -2.8, 0.15},
}};

}  // namespace

SkyShape cie_sky(int type) {
    if (type < 1 || type > cie_sky_count) {
        throw lightcuts::invalid_input("the CIE has no standard sky " + std::to_string(type) + "; take one of 1 to " +
                                       std::to_string(cie_sky_count));
    }
    if (type == cie_sky_count) return {.s = 2.0};
    const Parameters& p = general[static_cast<std::size_t>(type - 1)];
    const double at_right_angles = std::exp(p.d * std::numbers::pi / 2.0);
    return {.a = p.a, .b = p.b, .c = p.c, .d = p.d, .e = p.e, .base = 1.0 - p.c * at_right_angles};
}

}  // namespace daylighting
