#pragma once

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <vector>

namespace benchmark {

/// Processor seconds of this thread: on a shared machine the clock on the wall measures the neighbors.
inline double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Processor seconds that `f()` takes on this thread.
template <class F>
double seconds(F&& f) {
    const double start = processor_seconds();
    f();
    return processor_seconds() - start;
}

/// The middle of an odd number of values.
inline double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

/// Nanoseconds that `each(i)`, which returns how many units it did, takes a unit: medians over runs.
template <class F>
double nanoseconds(int runs, int count, const F& each) {
    std::vector<double> times;
    for (int run = 0; run < runs; ++run) {
        double units = 0;
        const double spent = seconds([&] {
            for (int i = 0; i < count; ++i) units += static_cast<double>(each(i));
        });
        times.push_back(1e9 * spent / units);
    }
    return median(times);
}

}  // namespace benchmark
