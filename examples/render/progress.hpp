#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <mutex>

namespace render {

/// A line with the share done and the time left, rewritten on the terminal. Prints nothing elsewhere.
/// threads: `step` may be called by all.
class Progress {
public:
    /// `shown`: false keeps quiet even on a terminal.
    Progress(std::size_t steps, bool shown);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void step();

private:
    using Clock = std::chrono::steady_clock;

    std::size_t steps_;
    bool shown_;
    std::atomic<std::size_t> done_{0};
    std::mutex writing_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point written_{};
};

}  // namespace render
