#include <cstdint>
#include <vector>

#include <lightcuts/piecewise/approximate.hpp>

struct Rain {
    static constexpr int channels = 1;
    float millimeters = 0.0f;

    float operator[](int) const { return millimeters; }
    float& operator[](int) { return millimeters; }
    friend Rain operator+(const Rain& a, const Rain& b) { return {a.millimeters + b.millimeters}; }
    friend Rain operator*(const Rain& a, const Rain& b) { return {a.millimeters * b.millimeters}; }
    friend Rain operator*(const Rain& a, float k) { return {a.millimeters * k}; }
};

void approximate(const lightcuts::ClusterTree& tree, const std::vector<Rain>& rain) {
    const auto moments = lightcuts::moments(tree, [&](std::uint32_t item) { return rain[item]; });
    lightcuts::PiecewiseConstant<Rain> f;
    lightcuts::approximate(tree, moments, 1.0, f);
}
