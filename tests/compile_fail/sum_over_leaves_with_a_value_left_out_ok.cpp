#include <lightcuts/piecewise/algebra.hpp>

double sum(const lightcuts::PiecewiseConstant<float>& f, const lightcuts::PiecewiseConstant<float>& g) {
    return lightcuts::sum_over_leaves([](float a, float) { return a; }, f, g);
}
