#include <cstdint>
#include <vector>

#include <lightcuts/piecewise/algebra.hpp>

class OwnCut {
public:
    const std::vector<lightcuts::Piece>& pieces() const { return pieces_; }
    const std::vector<float>& values() const { return values_; }

private:
    std::vector<lightcuts::Piece> pieces_;
    std::vector<float> values_;
};

double sum(const OwnCut& f, const lightcuts::PiecewiseConstant<float>& g) { return lightcuts::sum_of_products(f, g); }
