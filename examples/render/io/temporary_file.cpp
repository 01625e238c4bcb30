#include "io/temporary_file.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstring>
#include <random>
#include <string>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

namespace render {

/// What a signal handler may know of a temporary file. In `creating` the file may come into being at any time.
struct TemporaryFile::Slot {
    enum State { unused, creating, present };

    std::atomic<int> state{unused};
    char path[PATH_MAX];
};

namespace {

using Slot = TemporaryFile::Slot;

constexpr const char* prefix = ".lightcuts-";
constexpr const char* suffix = ".tmp";

static_assert(std::atomic<int>::is_always_lock_free, "a signal handler may only touch lock-free atomics");
std::array<Slot, 32> slots;
std::atomic<bool> ending{false};

/// Keeps signals away from this thread, so that its handlers do not wait for what it is doing itself.
class SignalPause {
public:
    SignalPause() {
        sigset_t all;
        ::sigfillset(&all);
        ::pthread_sigmask(SIG_SETMASK, &all, &before_);
    }
    ~SignalPause() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
    SignalPause(const SignalPause&) = delete;
    SignalPause& operator=(const SignalPause&) = delete;

private:
    sigset_t before_;
};

/// A slot in `creating`; null if all are taken, and the file is then unknown to signal handlers.
Slot* take_slot() {
    for (Slot& slot : slots) {
        int unused = Slot::unused;
        if (!slot.state.compare_exchange_strong(unused, Slot::creating)) continue;
        if (ending.load()) {
            // Another thread's handler is ending the process: it must neither wait for this file nor miss it.
            slot.state.store(Slot::unused);
            for (;;) ::pause();
        }
        return &slot;
    }
    return nullptr;
}

std::filesystem::path new_name(const std::filesystem::path& folder) {
    static std::random_device random;
    char name[64];
    std::snprintf(name, sizeof name, "%s%ld-%08x%s", prefix, static_cast<long>(::getpid()), random(), suffix);
    return folder / name;
}

bool is_temporary(const std::string& name) { return name.starts_with(prefix) && name.ends_with(suffix); }

}  // namespace

TemporaryFile::TemporaryFile(const std::filesystem::path& folder) {
    const SignalPause pause;
    slot_ = take_slot();
    try {
        create(folder.empty() ? "." : folder);
    } catch (...) {
        forget();
        throw;
    }
    if (slot_) slot_->state.store(Slot::present);
}

void TemporaryFile::create(const std::filesystem::path& folder) {
    for (int attempt = 0; attempt < 100; ++attempt) {
        path_ = new_name(folder);
        if (slot_ && path_.native().size() < sizeof slot_->path) std::strcpy(slot_->path, path_.c_str());
        file_ = Descriptor(::open(path_.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, 0666));
        if (!file_ && errno != EEXIST) break;
        // Between these two another run may take the new file for one that was left behind.
        if (file_ && file_.lock() != Descriptor::Lock::busy && file_.is_at(path_)) return;
    }
    throw std::system_error(errno, std::generic_category());
}

void TemporaryFile::forget() {
    if (slot_) slot_->state.store(Slot::unused);
    slot_ = nullptr;
}

TemporaryFile::~TemporaryFile() {
    if (file_) ::unlink(path_.c_str());
    forget();
}

Descriptor TemporaryFile::rename_to(const std::filesystem::path& name) {
    if (::rename(path_.c_str(), name.c_str()) != 0) throw std::system_error(errno, std::generic_category());
    forget();
    return std::move(file_);
}

void remove_stale_temporaries(const std::filesystem::path& folder) {
    std::error_code ended;
    std::filesystem::directory_iterator entry(folder.empty() ? "." : folder, ended);
    for (; !ended && entry != std::filesystem::directory_iterator(); entry.increment(ended)) {
        const std::filesystem::path& path = entry->path();
        if (!is_temporary(path.filename().native())) continue;
        const Descriptor file(::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
        // A process that still writes the file holds its lock until the file has its final name.
        if (file && file.lock() == Descriptor::Lock::held && file.is_at(path)) ::unlink(path.c_str());
    }
}

void delete_temporaries() noexcept {
    ending.store(true);
    for (Slot& slot : slots) {
        // Another thread is in `open`, which returns, unless a network hangs.
        for (long i = 0; i < 1'000'000'000 && slot.state.load() == Slot::creating; ++i) continue;
        if (slot.state.load() == Slot::present) ::unlink(slot.path);
    }
}

}  // namespace render
