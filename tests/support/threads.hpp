#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace lightcuts::test {

/// An executor of four threads, each of which takes the next task when it has done one: who does what is chance.
struct FourThreads {
    template <class Task>
    void operator()(std::size_t count, Task&& task) const {
        std::atomic<std::size_t> next = 0;
        const auto work = [&] {
            for (std::size_t i = next++; i < count; i = next++) task(i);
        };
        std::vector<std::jthread> others;
        for (std::size_t t = 1; t < std::min<std::size_t>(count, 4); ++t) others.emplace_back(work);
        work();
    }
};

}  // namespace lightcuts::test
