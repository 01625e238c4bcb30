// expect: a function's values need to be float, double or a Spectrum
#include <cstdint>
#include <vector>

#include <lightcuts/piecewise/approximate.hpp>

struct Rain {
    float millimeters = 0.0f;
};

void approximate(const lightcuts::ClusterTree& tree, const std::vector<Rain>& rain) {
    const auto moments = lightcuts::moments(tree, [&](std::uint32_t item) { return rain[item]; });
    lightcuts::PiecewiseConstant<Rain> f;
    lightcuts::approximate(tree, moments, 1.0, f);
}
