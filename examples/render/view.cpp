#include "view.hpp"

#include <cmath>
#include <sstream>
#include <string>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>
#include <lightcuts/core/invalid_input.hpp>
#include <lightcuts/core/random.hpp>
#include <lightcuts/core/vector.hpp>

namespace render {

namespace {

/// sin of the angle between view and up below which the picture's upright is not defined.
constexpr double smallest_sine = 1e-4;

/// Lengths whose squares floats can hold: what is done with rays is done in floats.
constexpr double shortest = 1e-18;
constexpr double longest = 1e18;

bool is_usable_length(double length) { return length >= shortest && length <= longest; }

double sine_between(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::length(glm::cross(glm::normalize(a), glm::normalize(b)));
}

bool is_finite(const glm::dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

std::string short_text(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

}  // namespace

glm::vec2 pixel_offset(std::uint64_t seed, std::uint32_t pixel, int sample, int spp) {
    if (spp == 1) return glm::vec2(0.5f);
    // The additive recurrence of the plastic number covers the square evenly for any number of samples.
    constexpr double step_x = 0.7548776662466927;
    constexpr double step_y = 0.5698402909980532;
    const double x = lightcuts::uniform01(lightcuts::hash_keys(seed, pixel, 0)) + step_x * sample;
    const double y = lightcuts::uniform01(lightcuts::hash_keys(seed, pixel, 1)) + step_y * sample;
    return {static_cast<float>(x - std::floor(x)), static_cast<float>(y - std::floor(y))};
}

LensSample lens_sample(std::uint64_t seed, std::uint32_t pixel, int sample, int spp) {
    if (spp == 1) return {};
    // The additive recurrence of four dimensions: that of two for each pair would tie the lens to the pixel.
    constexpr double root = 1.1673039782614187;  // of x^5 = x + 1
    double step = 1.0;
    glm::vec4 p(0.0f);
    for (int axis = 0; axis < 4; ++axis) {
        step /= root;
        const double x = lightcuts::uniform01(lightcuts::hash_keys(seed, pixel, axis, 1)) + step * sample;
        p[axis] = static_cast<float>(x - std::floor(x));
    }
    return {{p.x, p.y}, {p.z, p.w}};
}

View::View(const Camera& camera, const glm::dvec3& origin, int width, int height, const Lens& lens)
    : width_(width), height_(height), eye_(camera.eye - origin), is_orthographic_(camera.height > 0.0), lens_(lens) {
    const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(camera.up)));
    const glm::dvec3 up = glm::cross(right, forward);
    const double view_height = is_orthographic_
                                   ? camera.height
                                   : 2.0 * std::tan(0.5 * glm::radians(static_cast<double>(camera.vertical_fov)));
    const double pixel = view_height / height;
    const glm::dvec3 to_corner = -0.5 * pixel * (static_cast<double>(width) * right - static_cast<double>(height) * up);
    forward_ = glm::vec3(forward);
    right_ = glm::vec3(pixel * right);
    down_ = glm::vec3(-pixel * up);
    corner_ = glm::vec3(is_orthographic_ ? to_corner : forward + to_corner);
}

EyeRay View::ray(float x, float y) const {
    const glm::vec3 on_plane = corner_ + x * right_ + y * down_;
    if (is_orthographic_) return {eye_ + on_plane, forward_};
    return {eye_, glm::normalize(on_plane)};
}

EyeRay View::ray(float x, float y, const glm::vec2& lens) const {
    const EyeRay central = ray(x, y);
    if (!has_lens()) return central;
    // Evenly over the disk.
    const double r = 0.5 * lens_.aperture * std::sqrt(static_cast<double>(lens.x));
    const double angle = 6.283185307179586 * static_cast<double>(lens.y);
    const glm::dvec3 direction(central.direction);
    const glm::dvec3 sharp = direction * (lens_.focus / glm::dot(direction, glm::dvec3(forward_)));
    const glm::dvec3 across = glm::normalize(glm::dvec3(right_)), down = glm::normalize(glm::dvec3(down_));
    const glm::dvec3 shift = r * (std::cos(angle) * across + std::sin(angle) * down);
    return {glm::vec3(glm::dvec3(central.origin) + shift), glm::vec3(glm::normalize(sharp - shift))};
}

void require_usable(const Camera& camera, const std::string& where) {
    const auto require = [&](bool good, const std::string& problem) {
        if (!good) throw lightcuts::invalid_input(where + ": " + problem);
    };
    require(is_finite(camera.eye) && is_finite(camera.target) && lightcuts::is_finite(camera.up),
            "a coordinate is not finite; give --eye and --target");
    require(camera.target != camera.eye, "the target is at the eye; give --eye and --target");
    const glm::dvec3 forward = camera.target - camera.eye;
    const double distance = glm::length(forward);
    const double upright = glm::length(glm::dvec3(camera.up));
    const std::string range = "between " + short_text(shortest) + " and " + short_text(longest);
    require(is_usable_length(distance), "the target is " + short_text(distance) + " from the eye, and has to be " +
                                            range + "; give another --eye or --target");
    require(glm::length(camera.eye) <= longest, "the eye is " + short_text(glm::length(camera.eye)) +
                                                    " from the origin, and has to be at most " + short_text(longest) +
                                                    "; give another --eye");
    require(upright == 0.0 || is_usable_length(upright),
            "the up vector's length is " + short_text(upright) + ", and has to be " + range + "; give another --up");
    require(upright > 0.0 && sine_between(forward, glm::dvec3(camera.up)) > smallest_sine,
            "the up vector does not cross the view; give another --up");
    require(camera.height > 0.0 || (camera.vertical_fov > 0.0f && camera.vertical_fov < 180.0f),
            "the field of view is not between 0 and 180 degrees; give --fov");
}

glm::vec3 default_up(const glm::dvec3& eye, const glm::dvec3& target) {
    const glm::dvec3 up(0.0, 1.0, 0.0);
    const glm::dvec3 view = target - eye;
    const bool vertical = glm::length(view) > 0.0 && sine_between(view, up) < smallest_sine;
    return vertical ? glm::vec3(0.0f, 0.0f, -1.0f) : glm::vec3(up);
}

}  // namespace render
