#pragma once

#include <concepts>
#include <cstddef>

namespace lightcuts {

namespace detail {
/// A task that captures something.
struct AnyTask {
    std::size_t* where;
    void operator()(std::size_t i) const { where[i] = i; }
};
}  // namespace detail

/// Something that calls `task(i)` once for each i in [0, count), in any order and on any threads, and returns when
/// all calls have. A lambda over a thread pool, `tbb::parallel_for` or a `for` loop will do.
/// An exception thrown by a task may end the executor as its author likes; the library's tasks throw only
/// std::bad_alloc.
template <class E>
concept Executor = requires(const E& execute, std::size_t count, const detail::AnyTask& task) {
    execute(count, task);
};

/// The default executor: a loop on the calling thread.
struct Sequential {
    template <class Task>
    constexpr void operator()(std::size_t count, Task&& task) const {
        for (std::size_t i = 0; i < count; ++i) task(i);
    }
};

}  // namespace lightcuts
