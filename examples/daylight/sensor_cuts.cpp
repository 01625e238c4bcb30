#include "sensor_cuts.hpp"

namespace daylighting {

void CutMaker::make(const DirectionTree& directions, const Facing& facing, const std::vector<float>& visibility,
                    double error, SensorCuts& cuts) {
    facing.moments(directions.tree, visibility, moments_);
    ordered_.start(directions.tree, moments_);
    ordered_.refine_to_total_error(error * facing.norm(moments_.back()));
    ordered_.store(cuts.sky);
    // Far below what any two directions make that differ; rounding makes less.
    lightcuts::approximate(directions.tree, moments_, 1e-7, cuts.sun);
}

}  // namespace daylighting
