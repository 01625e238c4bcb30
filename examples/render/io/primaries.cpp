#include "io/primaries.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace render {

namespace {

/// XYZ of a chromaticity, with X + Y + Z = 1.
glm::dvec3 xyz_of(const glm::dvec2& c) { return {c.x, c.y, 1.0 - c.x - c.y}; }

/// XYZ of white, with Y = 1.
glm::dvec3 white_of(const Primaries& p) { return xyz_of(p.white) / p.white.y; }

/// To XYZ; (1, 1, 1) has Y = 1.
glm::dmat3 to_xyz(const Primaries& p) {
    const glm::dmat3 directions(xyz_of(p.red), xyz_of(p.green), xyz_of(p.blue));
    const double volume = glm::determinant(directions);
    if (!(std::abs(volume) > 1e-6) || !(p.white.y > 1e-6) || !std::isfinite(volume)) {
        throw std::runtime_error("its primaries and white span no colors");
    }
    const glm::dvec3 amounts = glm::inverse(directions) * white_of(p);
    return {directions[0] * amounts[0], directions[1] * amounts[1], directions[2] * amounts[2]};
}

/// What makes the white `from` look as the white `to` does: scales the responses of the eye's cones.
glm::dmat3 adaptation(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dmat3 cones(glm::dvec3(0.8951, -0.7502, 0.0389), glm::dvec3(0.2664, 1.7135, -0.0685),
                           glm::dvec3(-0.1614, 0.0367, 1.0296));
    const glm::dvec3 scale = (cones * to) / (cones * from);
    const glm::dmat3 scaling(glm::dvec3(scale.x, 0.0, 0.0), glm::dvec3(0.0, scale.y, 0.0),
                             glm::dvec3(0.0, 0.0, scale.z));
    return glm::inverse(cones) * scaling * cones;
}

/// The weights of luminance: the row of Y.
glm::dvec3 luminance_of(const glm::dmat3& to_xyz) { return {to_xyz[0].y, to_xyz[1].y, to_xyz[2].y}; }

/// Whether the primaries are equal, to what files round; white may differ.
bool same_colors(const Primaries& a, const Primaries& b) {
    const auto near = [](const glm::dvec2& p, const glm::dvec2& q) {
        return std::abs(p.x - q.x) < 0.002 && std::abs(p.y - q.y) < 0.002;
    };
    return near(a.red, b.red) && near(a.green, b.green) && near(a.blue, b.blue);
}

bool is_unknown(const Primaries& p) {
    const glm::dvec2 zero(0.0);
    return p.red == zero && p.green == zero && p.blue == zero && p.white == zero;
}

}  // namespace

glm::dvec3 ColorConversion::operator()(const glm::dvec3& color) const {
    const glm::dvec3 converted = matrix_ * color;
    const double least = std::min({converted.r, converted.g, converted.b});
    if (!(least < 0.0) || color.r < 0.0 || color.g < 0.0 || color.b < 0.0) return converted;
    const double gray = glm::dot(luminance_, converted);
    if (!(gray > 0.0)) return glm::dvec3(0.0);
    // The share of the color that is left when its least channel has become zero; rounding must not bring that back.
    return glm::max(glm::dvec3(gray) + gray / (gray - least) * (converted - gray), 0.0);
}

ColorConversion from_xyz(const Primaries& to) {
    const glm::dmat3 matrix = to_xyz(to);
    return {glm::inverse(matrix), luminance_of(matrix)};
}

std::optional<ColorConversion> to_rec709(const Primaries& from) {
    if (is_unknown(from) || same_colors(from, rec709_primaries) || same_colors(from, radiance_primaries)) return {};
    const glm::dmat3 target = to_xyz(rec709_primaries);
    const glm::dmat3 source = to_xyz(from);
    const glm::dmat3 adapted = adaptation(white_of(from), white_of(rec709_primaries)) * source;
    return ColorConversion(glm::inverse(target) * adapted, luminance_of(target));
}

}  // namespace render
