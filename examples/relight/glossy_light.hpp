#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <lightcuts/tree/cluster_tree.hpp>

#include "cluster_lights.hpp"
#include "glossy_lobe.hpp"
#include "lit_sum.hpp"

namespace relight {

/// A cluster as a point sees it.
struct SeenCluster {
    glm::vec3 direction{0.0f};  ///< of its middle
    float radius = 0.0f;        ///< an angle
};

/// Adds to `sum` the light of all clusters, seen where the corners weigh so much: of a cluster at once, or, where the
/// lobe varies over it, of the nodes of its merge and those below them, down to leaves. `see(i)`: cluster i,
/// `see_node(node)`: a node of `tree`, both as a SeenCluster; `power_of(node)`: its light. `open`: storage.
template <class See, class SeeNode, class PowerOf>
void add_glossy_light(LitSum& sum, const GlossyLobe& lobe, const ClusterLights& lights, const glm::vec3& corners,
                      const lightcuts::ClusterTree& tree, const See& see, const SeeNode& see_node,
                      const PowerOf& power_of, std::vector<std::uint32_t>& open) {
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const SeenCluster whole = see(i);
        if (!lobe.is_coarse(whole.radius, whole.direction)) {
            sum.add(whole.direction, lights.power(i, corners));
            continue;
        }
        for (std::size_t k = lights.begin(i); k < lights.end(i); ++k) {
            const float visible = glm::dot(lights.node(k).visible, corners);
            open.assign(1, lights.node(k).node);
            while (!open.empty()) {
                const std::uint32_t node = open.back();
                open.pop_back();
                const SeenCluster at = see_node(node);
                if (!tree.is_leaf(node) && lobe.is_coarse(at.radius, at.direction)) {
                    open.push_back(tree.left(node));
                    open.push_back(tree.right(node));
                } else {
                    sum.add(at.direction, power_of(node) * visible);
                }
            }
        }
    }
}

}  // namespace relight
