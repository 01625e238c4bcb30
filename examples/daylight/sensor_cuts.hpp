#pragma once

#include <vector>

#include <lightcuts/piecewise/approximate.hpp>
#include <lightcuts/piecewise/piecewise_constant.hpp>

#include "facing.hpp"

namespace daylighting {

/// A sensor's visibility, kept twice.
struct SensorCuts {
    /// What is multiplied with skies: as few pieces as an error allows.
    lightcuts::PiecewiseConstant<float> sky;
    /// What is asked whether the sun is seen: exact at every direction before the sensor. A sun that is blurred over a
    /// piece would be the largest error of all.
    lightcuts::PiecewiseConstant<float> sun;
};

/// Makes the cuts of sensors. Keep one a thread.
class CutMaker {
public:
    /// Approximates `visibility`, a value each direction: `cuts.sky` in the fewest pieces, about, whose L2 error,
    /// directions weighted by their cosine, is at most `error` of the L2 norm of the visibility itself; so that
    /// sensors that see little of the sky are as good as those that see much. cost: O(N + pieces log pieces).
    void make(const DirectionTree& directions, const Facing& facing, const std::vector<float>& visibility, double error,
              SensorCuts& cuts);

private:
    std::vector<lightcuts::Moments<1>> moments_;
    lightcuts::OrderedApproximation<float> ordered_;
};

}  // namespace daylighting
