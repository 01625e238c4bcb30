#pragma once

#include <cstdint>
#include <utility>

#include "../core/assertion.hpp"
#include "../visibility/oracle.hpp"

namespace lightcuts::detail {

/// How likely something of a cluster on a receiver's cut is visible, as the oracle predicts it: a factor of priorities,
/// in (0, 1]. 1 of any cluster if the oracle predicts nothing.
template <class Oracle, class R>
class Prediction {
public:
    static constexpr bool predicts = false;

    Prediction(const Oracle&, const R&) {}

    template <class Node>
    double operator()(const Node&) const {
        return 1.0;
    }
};

template <class Oracle, class R>
    requires PredictingOracle<Oracle, R>
class Prediction<Oracle, R> {
public:
    static constexpr bool predicts = true;

    Prediction(const Oracle& oracle, const R& receiver) : likely_(oracle.likely_visible(receiver)) {}

    template <class Node>
    double operator()(const Node& n) const {
        const auto likely = static_cast<float>(likely_(std::uint32_t{n.kind}, std::uint32_t{n.node}));
        LIGHTCUTS_ASSERT(likely > 0.0f && likely <= 1.0f);
        return static_cast<double>(likely);
    }

private:
    decltype(std::declval<const Oracle&>().likely_visible(std::declval<const R&>())) likely_;
};

}  // namespace lightcuts::detail
