#pragma once

#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace lightcuts {

/// Input that a cold path (a builder, a source, a file reader) cannot use.
/// `what()` is one line: what is wrong, where (an index, or a file and line), what to do.
class invalid_input : public std::invalid_argument {
public:
    using std::invalid_argument::invalid_argument;
};

namespace detail {

/// Prints what is wrong and ends the program.
[[noreturn]] inline void end_program(const invalid_input& error) {
    std::fprintf(stderr, "lightcuts: %s\n", error.what());
    std::abort();
}

}  // namespace detail

}  // namespace lightcuts

/// How invalid input is refused: `LIGHTCUTS_THROW(error)` throws `error`, an `invalid_input`. Compiled without
/// exceptions it prints what is wrong to the standard error output and ends the program. Define it before including the
/// library to replace it; it must not return, and every translation unit has to define it alike.
#ifndef LIGHTCUTS_THROW
#if defined(__cpp_exceptions) || defined(_CPPUNWIND)
#define LIGHTCUTS_THROW(error) throw error
#else
#define LIGHTCUTS_THROW(error) ::lightcuts::detail::end_program(error)
#endif
#endif
