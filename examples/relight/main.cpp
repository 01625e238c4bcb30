#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include <render/interrupt.hpp>
#include <render/io/escape.hpp>
#include <render/io/standard_streams.hpp>
#include <render/memory.hpp>
#include <render/program.hpp>

#include "options.hpp"
#include "prepare.hpp"
#include "render_frames.hpp"

namespace {

enum ExitStatus { done = 0, bad_input = 1, bad_command_line = 2 };

void run(const relight::Options& options) {
    using Action = relight::Options::Action;
    switch (options.action) {
        case Action::help: render::print(options.help); break;
        case Action::version: render::print("lightcuts-relight " + render::program_version() + "\n"); break;
        case Action::prepare: relight::prepare(options); break;
        case Action::render: relight::render_frames(options); break;
    }
}

ExitStatus fail(ExitStatus status, const std::string& message) {
    std::fprintf(stderr, "lightcuts-relight: %s\n", render::escaped(message).c_str());
    return status;
}

}  // namespace

int main(int argc, char** argv) {
    render::guard_standard_streams();
    // Files are written in one step, so that a signal may end the program at any time.
    render::watch_signals("lightcuts-relight");
    render::watch_termination("lightcuts-relight");
    try {
        run(relight::parse_options(argc, argv));
        return done;
    } catch (const render::usage_error& e) {
        return fail(bad_command_line, std::string(e.what()) + " (--help lists the options)");
    } catch (const std::bad_alloc&) {
        return fail(bad_input, render::memory_shortage());
    } catch (const std::exception& e) { return fail(bad_input, render::explanation(e)); }
}
