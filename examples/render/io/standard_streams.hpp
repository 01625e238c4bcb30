#pragma once

#include <string>

namespace render {

/// The first call of a program. A full file and a reader that went away become errors of writing instead of signals
/// that end the program; a standard stream that the parent closed stays one that fails, instead of a number that the
/// next file to be opened gets.
void guard_standard_streams();

/// Writes `text` to the standard output. throws: std::runtime_error in one line unless all of it has arrived.
void print(const std::string& text);

}  // namespace render
