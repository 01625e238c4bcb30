#pragma once

#include "options.hpp"

namespace relight {

/// Makes the pictures that `options` ask for, with a report beside the first. throws: invalid_input; usage_error for a
/// camera's options that do not go together with it.
void render_frames(const Options& options);

}  // namespace relight
