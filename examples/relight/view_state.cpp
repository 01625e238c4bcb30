#include "view_state.hpp"

#include <charconv>
#include <cmath>

namespace relight {

namespace {

/// Degrees by which a drag over the height of the picture turns.
constexpr double drag_turn = 180.0;
constexpr double key_turn = 5.0;
constexpr double key_stops = 1.0 / 3.0;
constexpr double notch = 0.9;

template <class Number>
std::string text_of(Number value) {
    char digits[32];
    return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

template <class Vector>
std::string list_of(const Vector& v) {
    return text_of(v.x) + "," + text_of(v.y) + "," + text_of(v.z);
}

/// Within [-180, 180).
double turned(double degrees, double by) {
    const double turn = std::remainder(degrees + by, 360.0);  // exact, within [-180, 180]
    return turn == 180.0 ? -180.0 : turn + 0.0;               // not -0
}

}  // namespace

ViewState::ViewState(const FrameState& start, double distance)
    : rotation(start.rotation), materials(start.materials), start_(start), orbit_(start.camera, distance) {}

void ViewState::drag(Drag what, double right, double down) {
    switch (what) {
        // What is seen follows the mouse.
        case Drag::orbit: orbit_.turn(-drag_turn * right, drag_turn * down); break;
        case Drag::light: rotation = turned(rotation, drag_turn * right); break;
        case Drag::shift: orbit_.shift(-right, down); break;
    }
}

void ViewState::scroll(double notches) { orbit_.approach(std::pow(notch, notches)); }

void ViewState::press(Key key) {
    switch (key) {
        case Key::light_left: rotation = turned(rotation, -key_turn); break;
        case Key::light_right: rotation = turned(rotation, key_turn); break;
        case Key::brighter: exposure += key_stops; break;
        case Key::darker: exposure -= key_stops; break;
        case Key::diffuse: materials.is_diffuse = !materials.is_diffuse; break;
        case Key::reset:
            orbit_.reset();
            rotation = start_.rotation;
            materials = start_.materials;
            exposure = 0.0;
            break;
    }
}

FrameState ViewState::frame(int width, int height) const {
    return {orbit_.camera(), rotation, materials, width, height};
}

std::string ViewState::options(int width, int height) const {
    const render::Camera& camera = orbit_.camera();
    std::string text;
    if (!(camera.height > 0.0)) {
        text = "--eye " + list_of(camera.eye) + " --target " + list_of(camera.target) + " --up " + list_of(camera.up) +
               " --fov " + text_of(camera.vertical_fov) + " ";
    }
    return text + "--rotate " + text_of(rotation) + " --materials " + (materials.is_diffuse ? "diffuse" : "full") +
           " --albedo " + text_of(materials.albedo) + " --gloss-width " + text_of(materials.gloss_width) + " --size " +
           std::to_string(width) + "x" + std::to_string(height);
}

std::string view_keys() {
    return "Mouse, over the picture:\n"
           "  left button   orbit the camera\n"
           "  right button  turn the light\n"
           "  middle button shift the camera\n"
           "  wheel         nearer, further\n"
           "Keys:\n"
           "  Left, Right   turn the light\n"
           "  Up, Down      brighter, darker\n"
           "  E             expose for it\n"
           "  D             all diffuse\n"
           "  R             start again\n"
           "  S             save the picture\n"
           "  Esc           close";
}

}  // namespace relight
