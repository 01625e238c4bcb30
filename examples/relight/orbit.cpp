#include "orbit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace relight {

namespace {

constexpr double highest = 89.0 * std::numbers::pi / 180.0;
constexpr double furthest = 1e6;

}  // namespace

Orbit::Orbit(const render::Camera& start, double distance)
    : start_(start), camera_(start), start_distance_(distance), distance_(distance) {}

glm::dvec3 Orbit::outwards() const { return glm::normalize(camera_.eye - camera_.target); }

void Orbit::place(const glm::dvec3& middle, const glm::dvec3& outwards) {
    camera_.target = middle;
    camera_.eye = middle + distance_ * outwards;
    // What a scene's file says of the camera at other instants is of where it was.
    camera_.at_instants.clear();
}

void Orbit::turn(double around, double up) {
    const glm::dvec3 out = outwards();
    const glm::dvec3 middle = camera_.eye - distance_ * out;
    const glm::dvec3 pole = glm::normalize(glm::dvec3(camera_.up));
    const double sine = std::clamp(glm::dot(out, pole), -1.0, 1.0);
    const double height = std::asin(sine);
    const glm::dvec3 level = glm::normalize(out - sine * pole);
    const double turned = glm::radians(around);
    const glm::dvec3 level_turned = std::cos(turned) * level + std::sin(turned) * glm::cross(pole, level);
    const double raised = std::clamp(height + glm::radians(up), std::min(-highest, height), std::max(highest, height));
    place(middle, std::cos(raised) * level_turned + std::sin(raised) * pole);
}

void Orbit::approach(double factor) {
    if (camera_.height > 0.0) {
        camera_.height = std::clamp(camera_.height * factor, start_.height / furthest, start_.height * furthest);
        return;
    }
    const glm::dvec3 out = outwards();
    const glm::dvec3 middle = camera_.eye - distance_ * out;
    distance_ = std::clamp(distance_ * factor, start_distance_ / furthest, start_distance_ * furthest);
    place(middle, out);
}

void Orbit::shift(double right, double up) {
    const glm::dvec3 out = outwards();
    const glm::dvec3 to_right = glm::normalize(glm::cross(glm::dvec3(camera_.up), out));
    const double half_view = 0.5 * glm::radians(static_cast<double>(camera_.vertical_fov));
    const double height = camera_.height > 0.0 ? camera_.height : 2.0 * std::tan(half_view) * distance_;
    place(camera_.eye - distance_ * out + height * (right * to_right + up * glm::cross(out, to_right)), out);
}

void Orbit::reset() {
    camera_ = start_;
    distance_ = start_distance_;
}

}  // namespace relight
