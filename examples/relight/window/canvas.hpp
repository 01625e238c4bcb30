#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <GLFW/glfw3.h>
#include <imgui.h>

#include "../frame_thread.hpp"

namespace relight {

/// GLFW, as long as this object lives. throws: std::runtime_error, in one line, where there is no display.
struct Glfw {
    Glfw();
    ~Glfw();
    Glfw(const Glfw&) = delete;
    Glfw& operator=(const Glfw&) = delete;
};

/// A window with its OpenGL context, which is that of the calling thread.
class Canvas {
public:
    /// Sizes in the window's coordinates. throws: std::runtime_error, in one line. pre: there is a Glfw.
    Canvas(int width, int height, const std::string& title);
    ~Canvas();
    Canvas(const Canvas&) = delete;
    Canvas& operator=(const Canvas&) = delete;

    GLFWwindow* get() const { return window_; }

    /// A picture of all that was drawn and is not yet shown, as a PNG file.
    std::vector<char> png() const;

private:
    GLFWwindow* window_ = nullptr;
};

/// Dear ImGui in a window. It chains the callbacks that the window has already, and keeps no settings.
struct Gui {
    explicit Gui(GLFWwindow* window);
    ~Gui();
    Gui(const Gui&) = delete;
    Gui& operator=(const Gui&) = delete;
};

/// A picture in the memory of the graphics card. Pixels are drawn as they are, each by the one that is nearest.
class Texture {
public:
    Texture();
    ~Texture();
    Texture(const Texture&) = delete;
    Texture& operator=(const Texture&) = delete;

    void set(const ShownFrame& frame);
    ImTextureID id() const { return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(name_)); }

private:
    GLuint name_ = 0;
};

}  // namespace relight
