#include "viewer.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>
#include <render/interrupt.hpp>
#include <render/io/escape.hpp>
#include <render/io/output_file.hpp>
#include <render/io/standard_streams.hpp>
#include <render/memory.hpp>
#include <render/stopwatch.hpp>

#include "../saved_picture.hpp"

namespace relight {

namespace {

/// The panel's layout settles within so many drawings.
constexpr int settling = 3;

}  // namespace

GLFWwindow* Viewer::listen() {
    GLFWwindow* const window = canvas_.get();
    glfwSetWindowUserPointer(window, this);
    glfwSetMouseButtonCallback(
        window, [](GLFWwindow* w, int button, int action, int) { of(w).on_button(button, action == GLFW_PRESS); });
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { of(w).on_move(x, y); });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double, double notches) { of(w).on_scroll(notches); });
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int) {
        if (action != GLFW_RELEASE) of(w).on_key(key);
    });
    return window;
}

void Viewer::on_button(int button, bool is_down) {
    drag_.reset();
    if (!is_down || !is_in_picture(x_)) return;
    if (button == GLFW_MOUSE_BUTTON_LEFT) drag_ = ViewState::Drag::orbit;
    if (button == GLFW_MOUSE_BUTTON_RIGHT) drag_ = ViewState::Drag::light;
    if (button == GLFW_MOUSE_BUTTON_MIDDLE) drag_ = ViewState::Drag::shift;
}

void Viewer::on_move(double x, double y) {
    const double height = picture_height_ / scale_;
    if (drag_) state_.drag(*drag_, (x - x_) / height, (y - y_) / height);
    x_ = x;
    y_ = y;
}

void Viewer::on_scroll(double notches) {
    if (is_in_picture(x_)) state_.scroll(notches);
}

void Viewer::on_key(int key) {
    // Somebody types a number into a slider.
    if (ImGui::GetIO().WantTextInput) return;
    using Key = ViewState::Key;
    switch (key) {
        case GLFW_KEY_ESCAPE: glfwSetWindowShouldClose(canvas_.get(), GLFW_TRUE); break;
        case GLFW_KEY_S: is_asked_to_save_ = true; break;
        case GLFW_KEY_E: ++fits_; break;
        case GLFW_KEY_LEFT: state_.press(Key::light_left); break;
        case GLFW_KEY_RIGHT: state_.press(Key::light_right); break;
        case GLFW_KEY_UP: state_.press(Key::brighter); break;
        case GLFW_KEY_DOWN: state_.press(Key::darker); break;
        case GLFW_KEY_D: state_.press(Key::diffuse); break;
        case GLFW_KEY_R: state_.press(Key::reset); break;
        default: break;
    }
}

/// The picture takes what the panel leaves of the window.
void Viewer::measure() {
    int width = 0, height = 0, pixels = 0, rows = 0;
    glfwGetWindowSize(canvas_.get(), &width, &height);
    glfwGetFramebufferSize(canvas_.get(), &pixels, &rows);
    if (width <= 0 || height <= 0 || pixels <= 0 || rows <= 0) return;  // minimized
    scale_ = static_cast<double>(pixels) / width;
    picture_width_ = std::max(1, pixels - static_cast<int>(std::lround(panel_width * scale_)));
    picture_height_ = rows;
}

void Viewer::receive() {
    const auto frame = frames_.take();
    if (!frame) return;
    const bool is_other = !shown_ || shown_->picture != frame->picture;
    shown_ = frame;
    texture_.set(*frame);
    drawn_since_ = 0;
    pictures_ += is_other ? 1 : 0;
    finished_ += is_other && frame->is_at_rest() ? 1 : 0;
    if (!options_.print_options || !is_current()) return;
    const std::string text = state_.options(picture_width_, picture_height_) + "\n";
    if (text != printed_) render::print(text);
    printed_ = text;
}

void Viewer::look_after_saving() {
    if (saving_.valid() && saving_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) end_saving();
    if (is_asked_to_save_ && !saving_.valid() && is_current()) begin_saving();
}

void Viewer::begin_saving() {
    is_asked_to_save_ = false;
    message_ = "saving";
    // Encoding takes longer than the window may be silent.
    saving_ = std::async(std::launch::async,
                         [whole = options_.view.output, frame = shown_] { return save_picture(whole, *frame); });
}

void Viewer::end_saving() {
    try {
        message_ = saving_.get().string() + " saved";
        if (!options_.view.quiet) std::fprintf(stderr, "lightcuts-relight: %s\n", render::escaped(message_).c_str());
    } catch (const std::exception& e) { tell_unsaved(render::explanation(e)); }
    drawn_since_ = 0;
}

void Viewer::finish_saving() {
    if (saving_.valid()) end_saving();
    if (is_asked_to_save_ && is_current()) {
        begin_saving();
        end_saving();
    }
    if (is_asked_to_save_) {
        tell_unsaved("the window was closed before the picture to save was finished; it is not saved");
    }
}

void Viewer::tell_unsaved(const std::string& why) {
    has_unsaved_ = true;
    message_ = why;
    std::fprintf(stderr, "lightcuts-relight: %s\n", render::escaped(message_).c_str());
}

void Viewer::draw_controls() {
    const auto slide = [](const char* label, float& value, float lowest, float highest, const char* format,
                          ImGuiSliderFlags flags = 0) {
        ImGui::TextUnformatted(label);
        ImGui::PushID(label);
        ImGui::SetNextItemWidth(-1.0f);
        const bool has_changed = ImGui::SliderFloat("", &value, lowest, highest, format,
                                                    flags | ImGuiSliderFlags_AlwaysClamp);
        ImGui::PopID();
        return has_changed;
    };
    auto rotation = static_cast<float>(state_.rotation);
    if (slide("Light turned by", rotation, -180.0f, 180.0f, "%.1f degrees")) {
        state_.rotation = static_cast<double>(rotation);
    }
    auto exposure = static_cast<float>(state_.exposure);
    if (slide("Exposure", exposure, -8.0f, 8.0f, "%+.2f stops")) state_.exposure = static_cast<double>(exposure);
    if (ImGui::Button("Expose for this picture (E)")) ++fits_;
    ImGui::Separator();
    ImGui::Checkbox("All materials diffuse (D)", &state_.materials.is_diffuse);
    slide("Albedo", state_.materials.albedo, 0.0f, 2.0f, "x %.2f");
    slide("Width of glossy lobes", state_.materials.gloss_width, 0.125f, 8.0f, "x %.2f", ImGuiSliderFlags_Logarithmic);
    ImGui::Separator();
    if (ImGui::Button("Save (S)")) is_asked_to_save_ = true;
    ImGui::SameLine();
    if (ImGui::Button("Start again (R)")) state_.press(ViewState::Key::reset);
    if (!message_.empty()) ImGui::TextWrapped("%s", message_.c_str());
}

void Viewer::draw_figures() {
    ImGui::Separator();
    if (!shown_) {
        ImGui::TextUnformatted("The first picture is being made.");
        return;
    }
    const FrameFigures& figures = shown_->figures;
    ImGui::Text("%d x %d%s", shown_->picture->width, shown_->picture->height, is_current() ? ", finished" : "");
    ImGui::Text("Frame: %.0f ms", 1e3 * shown_->seconds);
    ImGui::Text("  light %.0f ms, shading %.0f ms", 1e3 * figures.seconds_light, 1e3 * figures.seconds_shade);
    ImGui::Text("Illumination cut: %zu", figures.illumination_cut);
    ImGui::Text("Visibility cuts: %.1f on average", figures.mean_visibility_cut);
    ImGui::Text("Merged, a triangle: %.1f", figures.nodes_per_triangle());
    ImGui::Text("Clusters a point: %.1f", figures.clusters_per_point());
    if (figures.relit.glossy > 0) {
        ImGui::Text("Directions, a glossy point: %.1f", figures.directions_per_glossy_point());
    }
    if (ImGui::CollapsingHeader("Mouse and keys")) ImGui::TextUnformatted(view_keys().c_str());
}

void Viewer::draw() {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    ImGui::NewFrame();
    const auto width = static_cast<float>(picture_width_ / scale_);
    const float height = ImGui::GetIO().DisplaySize.y;
    if (shown_) ImGui::GetBackgroundDrawList()->AddImage(texture_.id(), ImVec2(0.0f, 0.0f), ImVec2(width, height));
    ImGui::SetNextWindowPos(ImVec2(width, 0.0f));
    ImGui::SetNextWindowSize(ImVec2(static_cast<float>(panel_width), height));
    ImGui::Begin("panel", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
    draw_controls();
    draw_figures();
    ImGui::End();
    ImGui::Render();
    int pixels = 0, rows = 0;
    glfwGetFramebufferSize(canvas_.get(), &pixels, &rows);
    glViewport(0, 0, pixels, rows);
    glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    ++drawn_since_;
}

void Viewer::show() {
    const render::Stopwatch since_start;
    render::Stopwatch busy;
    while (glfwWindowShouldClose(canvas_.get()) == GLFW_FALSE && !has_screenshot_ && !render::interrupted() &&
           !(options_.seconds > 0.0 && since_start.seconds() >= options_.seconds)) {
        measure();
        receive();
        frames_.show(wanted());
        look_after_saving();
        draw();
        if (!options_.screenshot.empty() && is_current() && drawn_since_ >= settling) {
            render::write_file(options_.screenshot, canvas_.png());
            has_screenshot_ = true;
        }
        glfwSwapBuffers(canvas_.get());
        // The first drawing also makes the driver's programs.
        if (pictures_ > 0) longest_ = std::max(longest_, busy.seconds());
        if (drawn_since_ < settling) {
            glfwPollEvents();
        } else {
            glfwWaitEventsTimeout(0.1);
        }
        busy.lap();
    }
}

render::ExitStatus Viewer::run() {
    try {
        show();
    } catch (...) {
        finish_saving();
        throw;
    }
    finish_saving();
    if (!options_.view.quiet) {
        std::fprintf(stderr, "%d pictures, %d of them finished; the window was never busy for more than %.0f ms\n",
                     pictures_, finished_, 1e3 * longest_);
    }
    if (render::interrupted()) return render::stopped;
    if (!options_.screenshot.empty() && !has_screenshot_) {
        throw std::runtime_error("the window was closed before its picture was finished; there is no screenshot");
    }
    return has_unsaved_ ? render::bad_input : render::done;
}

}  // namespace relight
