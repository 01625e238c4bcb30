#include "interrupt.hpp"

#include <atomic>
#include <csignal>

namespace render {

namespace {

std::atomic<bool> pressed{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

extern "C" void remember_interrupt(int signal) {
    pressed.store(true);
    std::signal(signal, SIG_DFL);
}

}  // namespace

void watch_interrupt() { std::signal(SIGINT, remember_interrupt); }

bool interrupted() { return pressed.load(std::memory_order_relaxed); }

}  // namespace render
