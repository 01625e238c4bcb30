// Pieces that are numbers of nodes alone, and do not say where their leaves end.
// expect: a function on a tree needs pieces() const, a contiguous range of Piece
#include <cstdint>
#include <vector>

#include <lightcuts/piecewise/algebra.hpp>

class OwnCut {
public:
    const std::vector<std::uint32_t>& pieces() const { return pieces_; }
    const std::vector<float>& values() const { return values_; }

private:
    std::vector<std::uint32_t> pieces_;
    std::vector<float> values_;
};

double sum(const OwnCut& f, const lightcuts::PiecewiseConstant<float>& g) { return lightcuts::sum_of_products(f, g); }
