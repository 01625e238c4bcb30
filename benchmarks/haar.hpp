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
    static HaarCube within(std::size_t side, const std::vector<float>& texels, double most_error);

    /// The same with the wavelets of largest L2 norm, so many that with the six means there are `most_terms` at most.
    static HaarCube of_terms(std::size_t side, const std::vector<float>& texels, std::size_t most_terms);

    /// Number of wavelets and scaling functions.
    std::size_t terms() const { return terms_; }
    std::size_t memory_bytes() const { return nodes_.size() * sizeof(Node) + sizeof(HaarCube); }
    /// The sum over all texels of the product of two functions of one size. cost: O(nodes of both).
    static double sum_of_products(const HaarCube& a, const HaarCube& b);
    /// The sum over all texels of the product of three functions of one size. cost: O(nodes of the union).
    static double sum_of_products(const HaarCube& a, const HaarCube& b, const HaarCube& c);
    /// The texels that the terms make.
    std::vector<float> texels() const;

private:
    struct Node {
        float right = 0, down = 0, diagonal = 0;  ///< added to or taken from the mean, in each quarter
        std::array<std::uint32_t, 4> child{};     ///< 0: none
    };
    /// `left_out`: the number of wavelets, from the smallest on, that are not kept; `squares`: of them all, ascending.
    HaarCube(std::size_t side, const std::vector<float>& texels, const std::vector<double>& squares,
             std::size_t left_out);
    static double product(const HaarCube& a, const HaarCube& b, std::uint32_t of_a, std::uint32_t of_b, double area);
    static double product(const HaarCube& a, const HaarCube& b, const HaarCube& c,
                          const std::array<std::uint32_t, 3>& nodes, const std::array<float, 3>& means, double area);

    std::size_t side_;
    std::array<float, 6> mean_{};
    std::array<std::uint32_t, 6> root_{};
    std::vector<Node> nodes_{Node{}};  ///< the first stands for none: no wavelets
    std::size_t terms_ = 0;
};

}  // namespace benchmark
