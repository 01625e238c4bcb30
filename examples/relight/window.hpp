#pragma once

#include <render/run_program.hpp>

#include "options.hpp"

namespace relight {

/// Shows pictures of the scene that `options` name in a window, until it is closed, or a signal comes: `stopped`. Of
/// the window's own, nothing is left behind. throws: invalid_input and usage_error as `render_frames`;
/// std::runtime_error where there is no display, or this build has no window.
render::ExitStatus show_window(const Options& options);

}  // namespace relight
