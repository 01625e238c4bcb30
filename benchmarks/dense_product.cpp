#include "dense_product.hpp"

#include <Eigen/Core>

namespace benchmark {

std::vector<float> dense_product(const std::vector<float>& rows, const std::vector<float>& columns, std::size_t inner) {
    const auto n = static_cast<Eigen::Index>(inner);
    using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Map<const RowMajor> a(rows.data(), static_cast<Eigen::Index>(rows.size()) / n, n);
    const Eigen::Map<const Eigen::MatrixXf> b(columns.data(), n, static_cast<Eigen::Index>(columns.size()) / n);
    std::vector<float> result(static_cast<std::size_t>(a.rows() * b.cols()));
    Eigen::Map<Eigen::MatrixXf>(result.data(), a.rows(), b.cols()).noalias() = a * b;
    return result;
}

}  // namespace benchmark
