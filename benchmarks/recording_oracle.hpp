#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lightcuts/visibility/query.hpp>

#include "rays/oracle.hpp"

namespace benchmark {

/// Shadow rays and how they came in batches.
struct RecordedRays {
    std::vector<lightcuts::VisibilityQuery> queries;
    std::vector<std::size_t> batch_ends;

    /// Calls `f(first, count)` for the queries of each batch.
    template <class F>
    void for_each_batch(F&& f) const {
        std::size_t begin = 0;
        for (const std::size_t end : batch_ends) {
            f(begin, end - begin);
            begin = end;
        }
    }
};

/// Answers as `oracle` does, and remembers what it was asked.
struct RecordingOracle {
    const render::OpaqueOracle& oracle;
    RecordedRays& record;

    void many(std::span<const lightcuts::VisibilityQuery> batch, std::span<float> answers) const {
        record.queries.insert(record.queries.end(), batch.begin(), batch.end());
        record.batch_ends.push_back(record.queries.size());
        oracle.many(batch, answers);
    }
};

}  // namespace benchmark
