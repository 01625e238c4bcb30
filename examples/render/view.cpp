#include "view.hpp"

#include <cmath>
#include <sstream>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
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

/// From the eye to the target. In double, where differences and squares of floats neither overflow nor vanish.
glm::dvec3 way(const glm::vec3& eye, const glm::vec3& target) { return glm::dvec3(target) - glm::dvec3(eye); }

double sine_between(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::length(glm::cross(glm::normalize(a), glm::normalize(b)));
}

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
    const double x = lightcuts::to_unit(lightcuts::hash_keys(seed, pixel, 0)) + step_x * sample;
    const double y = lightcuts::to_unit(lightcuts::hash_keys(seed, pixel, 1)) + step_y * sample;
    return {static_cast<float>(x - std::floor(x)), static_cast<float>(y - std::floor(y))};
}

View::View(const Camera& camera, int width, int height) : width_(width), height_(height), eye_(camera.eye) {
    const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
    const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::vec3 up = glm::cross(right, forward);
    const float pixel = 2.0f * std::tan(0.5f * glm::radians(camera.vertical_fov)) / static_cast<float>(height);
    right_ = pixel * right;
    down_ = -pixel * up;
    corner_ = forward - 0.5f * (static_cast<float>(width) * right_ + static_cast<float>(height) * down_);
}

EyeRay View::ray(float x, float y) const { return {eye_, glm::normalize(corner_ + x * right_ + y * down_)}; }

void require_usable(const Camera& camera, const std::string& where) {
    const auto require = [&](bool good, const std::string& problem) {
        if (!good) throw lightcuts::invalid_input(where + ": " + problem);
    };
    using lightcuts::is_finite;
    require(is_finite(camera.eye) && is_finite(camera.target) && is_finite(camera.up),
            "a coordinate is not finite; give --eye and --target");
    require(camera.target != camera.eye, "the target is at the eye; give --eye and --target");
    const glm::dvec3 forward = way(camera.eye, camera.target);
    const double distance = glm::length(forward);
    const double upright = glm::length(glm::dvec3(camera.up));
    const std::string range = "between " + short_text(shortest) + " and " + short_text(longest);
    require(is_usable_length(distance), "the target is " + short_text(distance) + " from the eye, and has to be " +
                                            range + "; give another --eye or --target");
    require(upright == 0.0 || is_usable_length(upright),
            "the up vector's length is " + short_text(upright) + ", and has to be " + range + "; give another --up");
    require(upright > 0.0 && sine_between(forward, camera.up) > smallest_sine,
            "the up vector does not cross the view; give another --up");
    require(camera.vertical_fov > 0.0f && camera.vertical_fov < 180.0f,
            "the field of view is not between 0 and 180 degrees; give --fov");
}

glm::vec3 default_up(const glm::vec3& eye, const glm::vec3& target) {
    const glm::vec3 up(0.0f, 1.0f, 0.0f);
    const glm::dvec3 forward = way(eye, target);
    const bool vertical = glm::length(forward) > 0.0 && sine_between(forward, up) < smallest_sine;
    return vertical ? glm::vec3(0.0f, 0.0f, -1.0f) : up;
}

}  // namespace render
