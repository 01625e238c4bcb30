#include "canvas.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>
#include <render/io/picture.hpp>

namespace relight {

namespace {

[[noreturn]] void refuse_window() {
    const char* why = nullptr;
    glfwGetError(&why);
    throw std::runtime_error("no window can be opened (" + std::string(why ? why : "for no known reason") +
                             "); start it on a desktop, or use render");
}

}  // namespace

Glfw::Glfw() {
    if (glfwInit() != GLFW_TRUE) refuse_window();
}

Glfw::~Glfw() { glfwTerminate(); }

Canvas::Canvas(int width, int height, const std::string& title) {
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 2);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (!window_) refuse_window();
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
}

Canvas::~Canvas() { glfwDestroyWindow(window_); }

std::vector<char> Canvas::png() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    const auto row = 3 * static_cast<std::ptrdiff_t>(width);
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(row * height));
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, bytes.data());
    // OpenGL's rows begin at the bottom.
    for (int y = 0; y < height / 2; ++y) {
        const auto upper = bytes.begin() + y * row;
        std::swap_ranges(upper, upper + row, bytes.begin() + (height - 1 - y) * row);
    }
    return render::png_bytes(width, height, bytes);
}

Gui::Gui(GLFWwindow* window) {
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::StyleColorsDark();
    ImGui_ImplGlfw_InitForOpenGL(window, true);
    ImGui_ImplOpenGL3_Init("#version 150");
}

Gui::~Gui() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

Texture::Texture() {
    glGenTextures(1, &name_);
    glBindTexture(GL_TEXTURE_2D, name_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

Texture::~Texture() { glDeleteTextures(1, &name_); }

void Texture::set(const ShownFrame& frame) {
    glBindTexture(GL_TEXTURE_2D, name_);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, frame.picture->width, frame.picture->height, 0, GL_RGB, GL_UNSIGNED_BYTE,
                 frame.bytes.data());
}

}  // namespace relight
