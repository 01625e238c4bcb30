#pragma once

#include <cstddef>

#include <oneapi/tbb/parallel_for.h>

namespace render {

/// Spreads the library's tasks over the threads of the calling task arena.
struct TbbExecutor {
    template <class Task>
    void operator()(std::size_t count, Task&& task) const {
        tbb::parallel_for(std::size_t{0}, count, task);
    }
};

}  // namespace render
