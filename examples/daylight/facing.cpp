#include "facing.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace daylighting {

Facing::Facing(const DirectionTree& directions, const glm::vec3& normal) : normal_(normal) {
    cosines_.reserve(directions.size());
    for (const glm::vec3& d : directions.directions) cosines_.push_back(std::max(0.0f, glm::dot(normal, d)));
    const lightcuts::ClusterTree& tree = directions.tree;
    weights_.resize(tree.size());
    for (std::uint32_t n = 0; n < tree.size(); ++n) {
        weights_[n] = tree.is_leaf(n) ? static_cast<double>(cosines_[tree.item(n)])
                                      : weights_[tree.left(n)] + weights_[tree.right(n)];
    }
}

void Facing::moments(const lightcuts::ClusterTree& tree, const std::vector<float>& visibility,
                     std::vector<lightcuts::Moments<1>>& result) const {
    result.resize(tree.size());
    for (std::uint32_t n = 0; n < tree.size(); ++n) {
        lightcuts::Moments<1>& m = result[n];
        if (tree.is_leaf(n)) {
            m.mean[0] = weights_[n] > 0.0 ? static_cast<double>(visibility[tree.item(n)]) : 0.0;
            m.squared_deviation[0] = 0.0;
            m.leaves = 1.0;
            continue;
        }
        const std::uint32_t left = tree.left(n), right = tree.right(n);
        const lightcuts::Moments<1>&a = result[left], &b = result[right];
        // Shares that add up as the weights did, so that equal values have exactly their own mean.
        const double share = weights_[n] > 0.0 ? weights_[right] / weights_[n] : 0.0;
        const double apart = weights_[left] > 0.0 ? b.mean[0] - a.mean[0] : 0.0;
        m.mean[0] = weights_[left] > 0.0 ? a.mean[0] + apart * share : b.mean[0];
        m.squared_deviation[0] = a.squared_deviation[0] + b.squared_deviation[0] +
                                 (weights_[right] > 0.0 ? apart * apart * weights_[left] * share : 0.0);
        m.leaves = a.leaves + b.leaves;
    }
}

double Facing::norm(const lightcuts::Moments<1>& root) const {
    return std::sqrt(root.squared_deviation[0] + weights_.back() * root.mean[0] * root.mean[0]);
}

}  // namespace daylighting
