#pragma once

#include <cstddef>
#include <vector>

#include "shading_cost.hpp"
#include "workload.hpp"

namespace benchmark {

/// Methods of the renderer that shade the same points by turns. Number 0 is the exhaustive sum.
class MethodContest {
public:
    /// At about `count` of the points of `work`, which is kept.
    MethodContest(const Workload& work, std::size_t count);
    MethodContest(const MethodContest&) = delete;
    MethodContest& operator=(const MethodContest&) = delete;

    /// One more method: the workload's options, as `change` leaves them. Returns its number.
    template <class F>
    std::size_t add(const F& change) {
        render::Options options = work_.options();
        change(options);
        return add_method(options);
    }
    /// Medians are over so many runs. pre: odd
    void run(int runs);

    std::size_t points() const { return points_.size(); }
    const ShadingCost& cost(std::size_t method) const { return methods_[method].cost(); }
    const std::vector<render::Shading>& shadings(std::size_t method) const { return methods_[method].shadings(); }
    /// Time of the exhaustive sum / time of the method.
    double speed_up(std::size_t method) const { return time_ratio(cost(0), cost(method)); }
    /// Relative RMSE against the exhaustive sum, in which virtual lights are clamped if the method clamps them.
    double error(std::size_t method) const;

private:
    std::size_t add_method(const render::Options& options);
    bool has_other_truth(std::size_t method) const { return clamps_[0] && !clamps_[method]; }

    const Workload& work_;
    std::vector<render::SurfacePoint> points_;
    std::vector<TimedMethod> methods_;
    std::vector<bool> clamps_;
    std::vector<render::Shading> unclamped_;  ///< the exhaustive sum, if a method needs it
};

}  // namespace benchmark
