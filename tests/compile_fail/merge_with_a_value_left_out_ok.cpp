#include <cstdint>

#include <lightcuts/piecewise/merge.hpp>

double sum(const lightcuts::PiecewiseConstant<float>& f, const lightcuts::PiecewiseConstant<float>& g) {
    double total = 0.0;
    lightcuts::merge(
        [&](std::uint32_t, std::uint32_t leaves, float a, float b) { total += leaves * static_cast<double>(a * b); }, f,
        g);
    return total;
}
