#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace lightcuts::test {

/// An executor of up to `most` threads, one of them the caller's, each of which takes the next task when it has done
/// one: which thread runs which task differs from run to run.
struct Threads {
    std::size_t most;

    template <class Task>
    void operator()(std::size_t count, Task&& task) const {
        std::atomic<std::size_t> next = 0;
        const auto work = [&] {
            for (std::size_t i = next++; i < count; i = next++) task(i);
        };
        std::vector<std::jthread> others;
        for (std::size_t t = 1; t < std::min(count, most); ++t) others.emplace_back(work);
        work();
    }
};

/// An executor of four threads.
struct FourThreads : Threads {
    FourThreads() : Threads{4} {}
};

}  // namespace lightcuts::test
