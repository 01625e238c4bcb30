#include "method_contest.hpp"

#include <algorithm>

namespace benchmark {

MethodContest::MethodContest(const Workload& work, std::size_t count)
    : work_(work), points_(spread(work.points(), count)) {
    add([](render::Options& options) { options.method = "exhaustive"; });
}

std::size_t MethodContest::add_method(const render::Options& options) {
    methods_.emplace_back(work_.scene(), work_.rays(), points_, options);
    clamps_.push_back(work_.scene().virtual_count() > 0 && options.clamping().has_threshold());
    return methods_.size() - 1;
}

void MethodContest::run(int runs) {
    run_by_turns(methods_, runs);
    if (std::find(clamps_.begin(), clamps_.end(), false) == clamps_.end() || !clamps_[0]) return;
    render::Options options = work_.options();
    options.method = "exhaustive";
    options.clamp = {};
    TimedMethod sum(work_.scene(), work_.rays(), points_, options);
    sum.run();
    unclamped_ = sum.shadings();
}

double MethodContest::error(std::size_t method) const {
    return relative_rmse(methods_[method].shadings(),
                         has_other_truth(method) ? unclamped_ : methods_.front().shadings());
}

}  // namespace benchmark
