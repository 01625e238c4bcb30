#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>

#include <render/run_program.hpp>

#include "../frame_source.hpp"
#include "../frame_thread.hpp"
#include "../options.hpp"
#include "../view_state.hpp"
#include "canvas.hpp"

namespace relight {

/// A window with a picture on the left, which answers to mouse and keys, and a panel on the right.
class Viewer {
public:
    /// `options` and `source` must outlive this object. `scene`: its name, for the title. throws: std::runtime_error
    /// if there can be no window. pre: there is a Glfw.
    Viewer(const Options& options, const ViewState& state, FrameSource& source, int threads, const std::string& scene)
        : options_(options), state_(state),
          canvas_(options.view.width + panel_width, options.view.height, "lightcuts-relight: " + scene), gui_(listen()),
          frames_(source, threads, [] { glfwPostEmptyEvent(); }) {}

    /// Until the window is closed, or a signal comes: `stopped`. throws: what the source throws; invalid_input if the
    /// screenshot cannot be written, std::runtime_error if there was no time for it.
    render::ExitStatus run();

private:
    static constexpr int panel_width = 280;  ///< in the window's coordinates

    static Viewer& of(GLFWwindow* window) { return *static_cast<Viewer*>(glfwGetWindowUserPointer(window)); }
    /// Sets the window's callbacks; returns it.
    GLFWwindow* listen();
    void on_button(int button, bool is_down);
    void on_move(double x, double y);
    void on_scroll(double notches);
    void on_key(int key);
    void measure();
    bool is_in_picture(double x) const { return x * scale_ < picture_width_; }
    bool is_current() const {
        return shown_ && shown_->is_at_rest() && shown_->state.frame == state_.frame(picture_width_, picture_height_);
    }

    void receive();
    void look_after_saving();
    void draw();
    void draw_controls();
    void draw_figures();

    const Options& options_;
    ViewState state_;
    Canvas canvas_;
    Gui gui_;
    Texture texture_;
    FrameThread frames_;

    double scale_ = 1.0;  ///< pixels for each unit of the window's coordinates
    int picture_width_ = 1, picture_height_ = 1;
    int fits_ = 0;
    std::optional<ViewState::Drag> drag_;
    double x_ = 0.0, y_ = 0.0;

    std::shared_ptr<const ShownFrame> shown_;
    std::string printed_;  ///< last
    int pictures_ = 0, finished_ = 0;
    int drawn_since_ = 0;  ///< since something came that is drawn
    double longest_ = 0.0;

    bool is_asked_to_save_ = false;
    std::future<std::string> saving_;
    std::string message_;
};

}  // namespace relight
