#include <render/io/standard_streams.hpp>
#include <render/program.hpp>
#include <render/run_program.hpp>

#include "options.hpp"
#include "prepare.hpp"
#include "render_frames.hpp"
#include "window.hpp"

namespace {

render::ExitStatus run(const relight::Options& options) {
    using Action = relight::Options::Action;
    switch (options.action) {
        case Action::help: render::print(options.help); break;
        case Action::version: render::print("lightcuts-relight " + render::program_version() + "\n"); break;
        case Action::prepare: relight::prepare(options); break;
        case Action::render: relight::render_frames(options); break;
        case Action::view: return relight::show_window(options);
    }
    return render::done;
}

}  // namespace

int main(int argc, char** argv) {
    // Files are written in one step, so that a signal may end the program at any time; a window closes first.
    return render::run_program("lightcuts-relight", [&] { return run(relight::parse_options(argc, argv)); });
}
