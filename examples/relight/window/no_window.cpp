#include <stdexcept>

#include "../window.hpp"

namespace relight {

render::ExitStatus show_window(const Options&) {
    throw std::runtime_error(
        "this build has no window; install GLFW, Dear ImGui and OpenGL (Debian: libglfw3-dev libimgui-dev libgl-dev) "
        "and build it anew, or use render");
}

}  // namespace relight
