#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace relight {

/// Clusters of directions, or of places, as the points of one triangle see them. The nodes of a merge are where
/// visibility and light are multiplied; a piece of the illumination cut, or a node above several, is a cluster, where
/// the BRDF is evaluated: it has the sum of the products of its nodes, for each of the triangle's corners. Side by
/// side, for loops over lanes.
class ClusterLights {
public:
    /// A node of the merge, and its visibility from the corners.
    struct Node {
        std::uint32_t node = 0;
        glm::vec3 visible{0.0f};
    };

    void clear();
    /// Adds a node to the current cluster: `where` it is, a direction or a place, and what arrives of it where it is
    /// seen, `power`, times how much each corner sees.
    void add(std::uint32_t node, const glm::vec3& where, const glm::vec3& power, const glm::vec3& visible);
    /// Ends the current cluster of directions, of the radius `radius`. Without nodes it is left out.
    void end_cluster(float radius);
    /// The same of places.
    void end_cluster_of_places(float radius);
    /// Fills up the last lanes with no light. Call it after the last cluster.
    void finish();

    /// Number of clusters.
    std::size_t size() const { return ends_.size(); }
    std::size_t node_count() const { return nodes_.size(); }
    /// Of cluster i.
    std::size_t begin(std::size_t i) const { return i == 0 ? 0 : ends_[i - 1]; }
    std::size_t end(std::size_t i) const { return ends_[i]; }
    float radius(std::size_t i) const { return radii_[i]; }
    /// The mean of its nodes' directions or places, weighted by what is seen of their light.
    glm::vec3 where(std::size_t i) const { return {x_[i], y_[i], z_[i]}; }
    /// What is seen of its light where the corners weigh so much.
    glm::vec3 power(std::size_t i, const glm::vec3& corners) const {
        return {corners.x * red_[0][i] + corners.y * red_[1][i] + corners.z * red_[2][i],
                corners.x * green_[0][i] + corners.y * green_[1][i] + corners.z * green_[2][i],
                corners.x * blue_[0][i] + corners.y * blue_[1][i] + corners.z * blue_[2][i]};
    }
    const Node& node(std::size_t k) const { return nodes_[k]; }

    /// The sum of power x cosine with the unit `normal`, over clusters above both normals: irradiance.
    /// pre: finish() has been called.
    glm::vec3 irradiance(const glm::vec3& corners, const glm::vec3& normal, const glm::vec3& horizon) const;
    /// The same of places, at `from`. pre: finish() has been called.
    glm::vec3 irradiance_from_places(const glm::vec3& corners, const glm::vec3& from, const glm::vec3& normal,
                                     const glm::vec3& horizon) const;

private:
    template <bool OfPlaces>
    glm::vec3 irradiance_at(const glm::vec3& corners, const glm::vec3& from, const glm::vec3& normal,
                            const glm::vec3& horizon) const;
    void append(const glm::vec3& where, float radius);

    template <class F>
    void for_each_lane(F&& f);

    std::vector<Node> nodes_;
    std::vector<std::size_t> ends_;                   ///< of each cluster, in `nodes_`
    std::vector<float> radii_;                        ///< by cluster
    std::vector<float> x_, y_, z_;                    ///< direction or place
    std::vector<float> red_[3], green_[3], blue_[3];  ///< power, as each corner sees it
    glm::mat3 power_{0.0f};                           ///< of the current cluster: a column a corner
    glm::vec3 towards_{0.0f};                         ///< sum of its directions or places, weighted
    float weight_ = 0.0f;                             ///< sum of the weights
};

}  // namespace relight
