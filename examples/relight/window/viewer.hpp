#pragma once

#include <filesystem>
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

    /// Until the window is closed, or a signal comes: `stopped`. Pictures that are being saved then are saved;
    /// `bad_input`, and a line on stderr for each, if one that was asked for could not be. throws: what the source
    /// throws; invalid_input if the screenshot cannot be written, std::runtime_error if there was no time for it.
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
    ShownState wanted() const { return {state_.frame(picture_width_, picture_height_), state_.exposure, fits_}; }
    /// What is wanted is shown, finished and exposed.
    bool is_current() const { return shown_ && shown_->is_at_rest() && shown_->state == wanted(); }

    void receive();
    void look_after_saving();
    /// Begins to save the picture that is shown.
    void begin_saving();
    /// Waits until it is saved, and tells of it.
    void end_saving();
    /// Saves what was asked for and is finished, and tells of what is not.
    void finish_saving();
    /// Tells on stderr and in the panel of what was not saved.
    void tell_unsaved(const std::string& why);
    /// Until the window is closed, a signal comes, or time or screenshot is over.
    void show();
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

    bool has_screenshot_ = false;

    bool is_asked_to_save_ = false;
    bool has_unsaved_ = false;
    std::future<std::filesystem::path> saving_;
    std::string message_;
};

}  // namespace relight
