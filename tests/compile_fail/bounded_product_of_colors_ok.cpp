#include <lightcuts/piecewise/bounded_product.hpp>

double bound(const lightcuts::PiecewiseConstant<float>& visibility,
             const lightcuts::PiecewiseConstant<glm::vec3>& color) {
    return lightcuts::bounded_product(visibility, lightcuts::PiecewiseChannel(color, 0)).error_bound;
}
