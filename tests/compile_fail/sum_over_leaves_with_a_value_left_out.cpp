// expect: sum_over_leaves calls op(a value of each function)
#include <lightcuts/piecewise/algebra.hpp>

double sum(const lightcuts::PiecewiseConstant<float>& f, const lightcuts::PiecewiseConstant<float>& g) {
    return lightcuts::sum_over_leaves([](float a) { return a; }, f, g);
}
