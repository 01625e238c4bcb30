#pragma once

#include <chrono>

namespace render {

/// Measures time on the wall.
class Stopwatch {
public:
    /// Seconds since the last lap, or since construction.
    double seconds() const { return between(last_, Clock::now()); }
    /// The same, and a lap ends.
    double lap() {
        const Clock::time_point now = Clock::now();
        const double seconds = between(last_, now);
        last_ = now;
        return seconds;
    }

private:
    using Clock = std::chrono::steady_clock;

    static double between(Clock::time_point from, Clock::time_point to) {
        return std::chrono::duration<double>(to - from).count();
    }

    Clock::time_point last_ = Clock::now();
};

}  // namespace render
