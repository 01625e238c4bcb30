#pragma once

#include <string>

namespace benchmark {

/// What figures of time depend on.
struct Machine {
    std::string processor;
    unsigned threads = 0;  ///< that the machine can run at once
    std::string compiler;
    std::string build;  ///< with or without assertions
    std::string date;   ///< of today, YYYY-MM-DD, UTC
};

Machine this_machine();

/// One line.
std::string to_text(const Machine& machine);

}  // namespace benchmark
