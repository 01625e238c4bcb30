#pragma once

#include <render/scene.hpp>

namespace relight {

/// A camera that is led around a middle, which lies on its view.
class Orbit {
public:
    /// The middle is at `distance` from the eye. Until it is moved the camera is `start` to the last bit.
    /// pre: `render::require_usable` accepts the camera; distance > 0.
    Orbit(const render::Camera& start, double distance);

    const render::Camera& camera() const { return camera_; }
    double distance() const { return distance_; }

    /// The eye moves on its sphere: by `around` degrees about the camera's up vector, counter-clockwise seen from that
    /// end, and by `up` degrees towards it; it stays a degree away from both poles, or as near as it started.
    void turn(double around, double up);
    /// The distance is multiplied by `factor`, of an orthographic camera the height of its view; within a millionth
    /// and a million times what it was at the start. pre: factor > 0.
    void approach(double factor);
    /// Eye and middle move across the view, in heights of what the picture shows at the middle's distance.
    void shift(double right, double up);
    void reset();

private:
    /// From the middle to the eye, unit.
    glm::dvec3 outwards() const;
    void place(const glm::dvec3& middle, const glm::dvec3& outwards);

    render::Camera start_, camera_;
    double start_distance_, distance_;
};

}  // namespace relight
