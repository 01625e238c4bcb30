// expect: of several channels take a PiecewiseChannel each
#include <lightcuts/piecewise/bounded_product.hpp>

double bound(const lightcuts::PiecewiseConstant<float>& visibility,
             const lightcuts::PiecewiseConstant<glm::vec3>& color) {
    return lightcuts::bounded_product(visibility, color).error_bound;
}
