#pragma once

#include <string>

#include "frame_source.hpp"
#include "orbit.hpp"

namespace relight {

/// What a person who looks at a scene changes of the picture, by mouse and keys.
class ViewState {
public:
    enum class Drag { orbit, light, shift };
    enum class Key { light_left, light_right, brighter, darker, diffuse, reset };

    /// `start`: the picture of no changes, but for its size. `distance`: from its eye to what it is led around.
    ViewState(const FrameState& start, double distance);

    /// By so much, in shares of the picture's height, rightwards and downwards.
    void drag(Drag what, double right, double down);
    /// Notches of a wheel: nearer.
    void scroll(double notches);
    void press(Key key);

    /// The picture of the present state.
    FrameState frame(int width, int height) const;

    /// The options with which `render` makes that picture, if it gets the others that this program got. Without those
    /// of the camera if that is orthographic: there are none. Numbers are read back as they are, to the last bit.
    std::string options(int width, int height) const;

    double rotation = 0.0;  ///< degrees
    double exposure = 0.0;  ///< stops above the picture's own
    MaterialChange materials;

private:
    FrameState start_;
    Orbit orbit_;
};

/// A paragraph of help that says what mouse and keys do.
std::string view_keys();

}  // namespace relight
