#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace benchmark {

/// Real spherical harmonics of degrees 0 to order - 1, order^2 of them, orthonormal over the sphere; that of degree l
/// and -l <= m <= l is number l^2 + l + m. Without the sign of Condon and Shortley: those of degree 1 are positive
/// multiples of y, z, x.
class SphericalHarmonics {
public:
    explicit SphericalHarmonics(int order);

    std::size_t size() const { return static_cast<std::size_t>(order_) * static_cast<std::size_t>(order_); }
    /// Makes `values` the harmonics in a direction, which is unit. pre: `values` has size(). cost: O(size).
    void evaluate(const glm::dvec3& direction, std::span<double> values) const;

private:
    int order_;
    std::vector<double> forward_, backward_;  ///< of the recurrence by degree, a harmonic of m >= 0 each
};

/// The coefficients of functions on even directions: `functions[k][i]` in `directions[i]`, each direction standing for
/// 4 pi / N. They are scaled so that the product of two functions, summed over the directions, is the dot product of
/// their coefficients. cost: O(N x harmonics x functions).
std::vector<std::vector<float>> project(const SphericalHarmonics& harmonics, std::span<const glm::dvec3> directions,
                                        std::span<const std::vector<float>> functions);

/// The values in `directions` of the sum of the first harmonics, as many as there are `coefficients`, those of
/// `project`. cost: O(N x harmonics).
std::vector<float> expand(const SphericalHarmonics& harmonics, std::span<const glm::dvec3> directions,
                          std::span<const float> coefficients);

}  // namespace benchmark
