#include "progress.hpp"

#include <cmath>
#include <cstdio>

#include <unistd.h>

namespace render {

Progress::Progress(std::size_t steps, bool shown) : steps_(steps), shown_(shown && ::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    if (shown_) std::fputs("\r\033[K", stderr);
}

void Progress::step() {
    const std::size_t done = ++done_;
    if (!shown_) return;
    const std::unique_lock<std::mutex> lock(writing_, std::try_to_lock);
    const Clock::time_point now = Clock::now();
    if (!lock || now - written_ < std::chrono::milliseconds(200)) return;
    written_ = now;
    const double share = static_cast<double>(done) / static_cast<double>(steps_);
    const double spent = std::chrono::duration<double>(now - start_).count();
    const long left = std::lround(spent / share - spent);
    std::fprintf(stderr, "\r\033[K%3.0f %%  %ld:%02ld left", 100.0 * share, left / 60, left % 60);
    std::fflush(stderr);
}

}  // namespace render
