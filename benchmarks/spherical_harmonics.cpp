#include "spherical_harmonics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Core>

namespace benchmark {
namespace {

constexpr std::size_t block_size = 256;  // directions at once, so that products are of matrices

using Matrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic>;

/// What makes a sum over directions of a harmonic's square 1.
double norm_of(std::size_t directions) { return std::sqrt(4.0 * std::numbers::pi / static_cast<double>(directions)); }

/// Calls `visit(first direction, harmonics x directions)` block by block.
template <class Visit>
void for_each_block(const SphericalHarmonics& harmonics, std::span<const glm::dvec3> directions, const Visit& visit) {
    std::vector<double> values(harmonics.size());
    Matrix rows(static_cast<Eigen::Index>(harmonics.size()), static_cast<Eigen::Index>(block_size));
    for (std::size_t first = 0; first < directions.size(); first += block_size) {
        const std::size_t count = std::min(block_size, directions.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            harmonics.evaluate(directions[first + i], values);
            for (std::size_t k = 0; k < values.size(); ++k) {
                rows(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) = static_cast<float>(values[k]);
            }
        }
        visit(first, rows.leftCols(static_cast<Eigen::Index>(count)));
    }
}

}  // namespace

SphericalHarmonics::SphericalHarmonics(int order) : order_(order), forward_(size()), backward_(size()) {
    for (int l = 1; l < order; ++l) {
        for (int m = 0; m < l; ++m) {
            const auto at = static_cast<std::size_t>(l * l + l + m);
            const double square = 1.0 * l * l - 1.0 * m * m, before = (l - 1.0) * (l - 1.0);
            forward_[at] = std::sqrt((4.0 * l * l - 1.0) / square);
            if (m < l - 1) backward_[at] = std::sqrt((before - 1.0 * m * m) / (4.0 * before - 1.0));
        }
    }
}

void SphericalHarmonics::evaluate(const glm::dvec3& direction, std::span<double> values) const {
    // Of each m Legendre's functions without their powers of the sine, times the parts of (x + i y)^m.
    double real = std::numbers::sqrt2, imaginary = 0.0, first = std::sqrt(0.25 * std::numbers::inv_pi);
    for (int m = 0; m < order_; ++m) {
        double last = 0.0, current = first;
        for (int l = m; l < order_; ++l) {
            const int middle = l * l + l;
            if (l > m) {
                const auto at = static_cast<std::size_t>(middle + m);
                const double next = forward_[at] * (direction.z * current - backward_[at] * last);
                last = current;
                current = next;
            }
            if (m == 0) {
                values[static_cast<std::size_t>(middle)] = current;
            } else {
                values[static_cast<std::size_t>(middle + m)] = current * real;
                values[static_cast<std::size_t>(middle - m)] = current * imaginary;
            }
        }
        first *= std::sqrt((2.0 * m + 3.0) / (2.0 * m + 2.0));
        const double turned = real * direction.x - imaginary * direction.y;
        imaginary = real * direction.y + imaginary * direction.x;
        real = turned;
    }
}

std::vector<std::vector<float>> project(const SphericalHarmonics& harmonics, std::span<const glm::dvec3> directions,
                                        std::span<const std::vector<float>> functions) {
    const auto count = static_cast<Eigen::Index>(functions.size());
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(harmonics.size()), count);
    Matrix values(static_cast<Eigen::Index>(block_size), count);
    for_each_block(harmonics, directions, [&](std::size_t first, const auto& rows) {
        for (Eigen::Index k = 0; k < count; ++k) {
            for (Eigen::Index i = 0; i < rows.cols(); ++i) {
                values(i, k) = functions[static_cast<std::size_t>(k)][first + static_cast<std::size_t>(i)];
            }
        }
        const Matrix of_block = rows * values.topRows(rows.cols());
        sums += of_block.cast<double>();
    });
    sums *= norm_of(directions.size());
    std::vector<std::vector<float>> result(functions.size());
    for (std::size_t k = 0; k < functions.size(); ++k) {
        for (std::size_t i = 0; i < harmonics.size(); ++i) {
            result[k].push_back(static_cast<float>(sums(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k))));
        }
    }
    return result;
}

std::vector<float> expand(const SphericalHarmonics& harmonics, std::span<const glm::dvec3> directions,
                          std::span<const float> coefficients) {
    const Eigen::Map<const Eigen::VectorXf> weights(coefficients.data(),
                                                    static_cast<Eigen::Index>(coefficients.size()));
    std::vector<float> result(directions.size());
    const auto scale = static_cast<float>(norm_of(directions.size()));
    for_each_block(harmonics, directions, [&](std::size_t first, const auto& rows) {
        Eigen::Map<Eigen::VectorXf>(result.data() + first,
                                    rows.cols()) = scale * (rows.topRows(weights.size()).transpose() * weights);
    });
    return result;
}

}  // namespace benchmark
