#include "interrupt.hpp"

#include <atomic>
#include <cstring>

#include <signal.h>
#include <unistd.h>

#include "io/temporary_file.hpp"

namespace render {

namespace {

constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP};

std::atomic<const char*> name{"lightcuts"};
std::atomic<bool> deferred{false};
std::atomic<bool> pressed{false};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<const char*>::is_always_lock_free,
              "a signal handler may only touch lock-free atomics");

void write_text(const char* text) { static_cast<void>(!::write(STDERR_FILENO, text, std::strlen(text))); }

[[noreturn]] void end(const char* why) {
    static std::atomic<bool> begun{false};
    while (begun.exchange(true)) ::pause();
    delete_temporaries();
    write_text(name.load());
    write_text(why);
    ::_exit(interrupted_status);
}

extern "C" void on_signal(int) {
    if (!deferred.load()) end(": interrupted before there was anything to save\n");
    if (pressed.exchange(true)) end(": interrupted again; what was not yet saved is lost\n");
}

}  // namespace

void watch_signals(const char* program) {
    name.store(program);
    struct sigaction action {};
    action.sa_handler = on_signal;
    action.sa_flags = SA_RESTART;
    ::sigemptyset(&action.sa_mask);
    for (const int signal : signals) ::sigaddset(&action.sa_mask, signal);
    for (const int signal : signals) {
        struct sigaction before {};
        const bool ignored = ::sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN;
        if (!ignored) ::sigaction(signal, &action, nullptr);
    }
}

void defer_signals() { deferred.store(true); }

bool interrupted() { return pressed.load(std::memory_order_relaxed); }

}  // namespace render
