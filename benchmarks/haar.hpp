#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace benchmark {

/// A function on the six faces of a cube map as a sparse sum of two-dimensional Haar wavelets: the largest of them, in
/// a quadtree a face that has only the nodes with a wavelet in or below them.
class HaarCube {
public:
    /// `side`: texels along an edge of a face, a power of two. `texels`: 6 x side x side, face by face, row by row.
    /// `most_error`: the wavelets of smallest L2 norm are left out, as many as the L2 error allows.
    HaarCube(std::size_t side, const std::vector<float>& texels, double most_error);

    /// Number of wavelets and scaling functions.
    std::size_t terms() const { return terms_; }
    /// The sum over all texels of the product of three functions of one size. cost: O(nodes of the union).
    static double sum_of_products(const HaarCube& a, const HaarCube& b, const HaarCube& c);
    /// The texels that the terms make.
    std::vector<float> texels() const;

private:
    struct Node {
        float right = 0, down = 0, diagonal = 0;  ///< added to or taken from the mean, in each quarter
        std::array<std::uint32_t, 4> child{};     ///< 0: none
    };
    static double product(const HaarCube& a, const HaarCube& b, const HaarCube& c,
                          const std::array<std::uint32_t, 3>& nodes, const std::array<float, 3>& means, double area);

    std::size_t side_;
    std::array<float, 6> mean_{};
    std::array<std::uint32_t, 6> root_{};
    std::vector<Node> nodes_{Node{}};  ///< the first stands for none: no wavelets
    std::size_t terms_ = 0;
};

}  // namespace benchmark
