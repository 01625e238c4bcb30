#pragma once

#include <cstddef>
#include <vector>

namespace benchmark {

/// Eigen's product of dense matrices in single precision, compiled for the very processor that compiles it: a row of
/// `rows` each sensor, a column of `columns` each hour, both of `inner` numbers and stored one after the other. Returns
/// the result, a column each hour.
std::vector<float> dense_product(const std::vector<float>& rows, const std::vector<float>& columns, std::size_t inner);

}  // namespace benchmark
