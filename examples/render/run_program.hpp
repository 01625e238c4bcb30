#pragma once

#include <functional>

#include "interrupt.hpp"

namespace render {

enum ExitStatus { done = 0, bad_input = 1, bad_command_line = 2, stopped = interrupted_status };

/// The `main` of program `name`, a literal: does `action`, and returns its status. What `action` throws becomes one
/// line on stderr; signals end the program until `action` defers them.
int run_program(const char* name, const std::function<ExitStatus()>& action);

}  // namespace render
