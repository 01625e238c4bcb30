#include "memory.hpp"

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <optional>

#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include "io/temporary_file.hpp"

namespace render {

namespace {

const char* name = "lightcuts";

/// The limit of addresses that the process was given, if any.
std::optional<double> address_limit() {
    rlimit limit{};
    const bool limited = ::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
    return limited ? std::optional(static_cast<double>(limit.rlim_cur)) : std::nullopt;
}

[[noreturn]] void end() {
    char reason[256] = "unknown error";
    if (const std::exception_ptr current = std::current_exception()) {
        try {
            std::rethrow_exception(current);
        } catch (const std::bad_alloc&) {
            std::snprintf(reason, sizeof reason, "%s", memory_shortage());
        } catch (const std::exception& e) {
            std::snprintf(reason, sizeof reason, "%s", is_memory_short() ? memory_shortage() : explanation(e).c_str());
        } catch (...) {}
    }
    delete_temporaries();
    std::fprintf(stderr, "%s: %s\n", name, reason);
    ::_exit(EXIT_FAILURE);
}

}  // namespace

std::uint64_t peak_memory() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
    return static_cast<std::uint64_t>(usage.ru_maxrss);
#else
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024u;
#endif
}

bool is_memory_short() {
    constexpr std::size_t size = std::size_t{64} << 20;
    void* const probe = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (probe == MAP_FAILED) return true;
    ::munmap(probe, size);
    return false;
}

const char* memory_shortage() {
    static char text[256];
    const double used = static_cast<double>(peak_memory()) / 1e6;
    if (const auto limit = address_limit()) {
        std::snprintf(text, sizeof text,
                      "not enough memory: it takes more than the %.0f MB of addresses that are allowed (ulimit -v), of "
                      "which %.0f MB were in use; allow more, or give a smaller scene, --size or --threads",
                      *limit / 1e6, used);
    } else {
        std::snprintf(text, sizeof text,
                      "not enough memory: it takes more than the %.0f MB that were in use when the system gave no "
                      "more; give a smaller scene or --size",
                      used);
    }
    return text;
}

std::string explanation(const std::exception& problem) {
    const std::string words = problem.what();
    // The text is TBB's, in whichever exception it arrives.
    if (words.find("pthread_create") == std::string::npos) return words;
    if (address_limit() || is_memory_short()) return memory_shortage();
    return words + "; give a smaller --threads";
}

void watch_termination(const char* program) {
    name = program;
    std::set_terminate(end);
}

}  // namespace render
