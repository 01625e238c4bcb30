#pragma once

#include <stdexcept>
#include <string>

namespace lightcuts {

/// Input that a cold path (a builder, a source, a file reader) cannot use.
/// `what()` is one line: what is wrong, where (an index, or a file and line), what to do.
class invalid_input : public std::invalid_argument {
public:
    using std::invalid_argument::invalid_argument;
};

}  // namespace lightcuts
