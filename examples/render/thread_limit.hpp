#pragma once

#include <cstddef>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

namespace render {

/// Lets TBB use so many threads as long as this object lives; 0: all.
class ThreadLimit {
public:
    explicit ThreadLimit(int threads)
        : count_(threads > 0 ? threads : tbb::this_task_arena::max_concurrency()),
          limit_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count_)) {}

    int count() const { return count_; }

private:
    int count_;
    tbb::global_control limit_;
};

}  // namespace render
