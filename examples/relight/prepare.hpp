#pragma once

#include "options.hpp"

namespace relight {

/// Traces visibility at the vertices of `options.view.scene` and writes it to `options.view.output`, in one step.
/// throws: invalid_input.
void prepare(const Options& options);

}  // namespace relight
