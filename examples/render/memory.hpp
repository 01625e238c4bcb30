#pragma once

#include <cstdint>
#include <exception>
#include <string>

namespace render {

/// Largest resident memory of the process so far, bytes.
std::uint64_t peak_memory();

/// True iff the system refuses this process as much memory as a thread's stack or a block of the ray tracer takes. Then
/// an error of another library is a shortage of memory, whatever its message says.
bool is_memory_short();

/// One line on how much memory has not been enough, and on the limit if there is one. Allocates nothing. The text lasts
/// until the next call.
const char* memory_shortage();

/// What to say of an exception in one line. A thread that the system refuses is a shortage of memory for its stack, or
/// of threads.
std::string explanation(const std::exception& problem);

/// From now on a program that has no other way out, because a destructor of a library throws or the like, ends with
/// status 1, a line on stderr that begins with `program`, and no temporary file left. `program`: a literal.
void watch_termination(const char* program);

}  // namespace render
