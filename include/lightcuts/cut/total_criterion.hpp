#pragma once

#include "../core/spectrum.hpp"
#include "options.hpp"

namespace lightcuts::detail {

/// The part of a refinement problem that says when its nodes are good enough: each bound is compared with the running
/// total and a tenth of the adaptation [Multidimensional Lightcuts 2006, Eq. 15]. `Total`: a RunningTotal.
template <class Total>
class TotalCriterion {
public:
    TotalCriterion(Total& total, const LightcutOptions& options)
        : total_(total), threshold_(static_cast<double>(options.error_ratio)),
          floor_(0.1 * static_cast<double>(options.adaptation)) {}

    bool is_final(const typename Total::Node& n) const { return is_black(n.bound); }

    template <class Visit>
    void observe(const Visit& visit) {
        total_.update(visit, floor_);
    }

    void checkpoint() { total_.checkpoint(); }
    double priority_scale() const { return total_.priority_scale(); }
    double priority_spread() const { return total_.priority_spread(); }
    double priority(const typename Total::Node& n) const { return total_.priority(n, threshold_); }
    double threshold() const { return threshold_; }

protected:
    Total& total_;
    double threshold_;
    double floor_;  ///< radiance added to the total
};

}  // namespace lightcuts::detail
