#include "run_program.hpp"

#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "io/escape.hpp"
#include "io/standard_streams.hpp"
#include "memory.hpp"
#include "options.hpp"

namespace render {

int run_program(const char* name, const std::function<ExitStatus()>& action) {
    guard_standard_streams();
    watch_signals(name);
    watch_termination(name);
    const auto fail = [name](ExitStatus status, const std::string& message) {
        std::fprintf(stderr, "%s: %s\n", name, escaped(message).c_str());
        return status;
    };
    try {
        return action();
    } catch (const usage_error& e) {
        return fail(bad_command_line, std::string(e.what()) + " (--help lists the options)");
    } catch (const std::bad_alloc&) {
        // What was asked for has been given back: there is room for a message.
        return fail(bad_input, memory_shortage());
    } catch (const std::exception& e) { return fail(bad_input, explanation(e)); }
}

}  // namespace render
