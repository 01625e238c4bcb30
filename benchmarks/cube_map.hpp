#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>
#include <lightcuts/tree/cluster_tree.hpp>

namespace benchmark {

/// A sphere in 6 x side x side texels of one solid angle, by a map of a cube's faces that keeps areas [Rosca and Plonka
/// 2011, Uniform spherical grids via equal area projection from the cube to the sphere]: so an error over texels is one
/// over the sphere. Texels are numbered face by face, row by row.
class CubeMap {
public:
    /// `side`: texels along an edge of a face, a power of two.
    explicit CubeMap(std::size_t side);

    std::size_t side() const { return side_; }
    /// Of the texels' middles, unit.
    const std::vector<glm::dvec3>& directions() const { return directions_; }
    /// The point of a face, 0 to 5, at -1 <= u, v <= 1.
    static glm::dvec3 direction(std::size_t face, double u, double v);

    /// Each face halved along its longer side, down to texels, which are the items.
    lightcuts::ClusterTree tree() const;

private:
    std::size_t side_;
    std::vector<glm::dvec3> directions_;
};

}  // namespace benchmark
