#include "haar.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace benchmark {

namespace {

constexpr float sign_x[]{1, -1, 1, -1}, sign_y[]{1, 1, -1, -1};

/// The full transform of a face: means of each level, finest first.
struct Pyramid {
    std::vector<std::vector<double>> means;
    std::vector<std::size_t> sides;

    Pyramid(std::size_t side, const float* texels) {
        means.emplace_back(texels, texels + side * side);
        sides.push_back(side);
        for (std::size_t s = side / 2; s >= 1; s /= 2) {
            const std::vector<double>& fine = means.back();
            std::vector<double> coarse(s * s);
            for (std::size_t y = 0; y < s; ++y) {
                for (std::size_t x = 0; x < s; ++x) {
                    const std::size_t at = 2 * y * 2 * s + 2 * x;
                    coarse[y * s + x] = 0.25 * (fine[at] + fine[at + 1] + fine[at + 2 * s] + fine[at + 2 * s + 1]);
                }
            }
            means.push_back(std::move(coarse));
            sides.push_back(s);
        }
    }
    /// The three wavelets of a quad: level 1 is made of four texels.
    std::array<double, 3> wavelets(std::size_t level, std::size_t x, std::size_t y) const {
        const std::vector<double>& fine = means[level - 1];
        const std::size_t width = sides[level - 1], at = 2 * y * width + 2 * x;
        const double a = fine[at], b = fine[at + 1], c = fine[at + width], d = fine[at + width + 1];
        return {0.25 * (a - b + c - d), 0.25 * (a + b - c - d), 0.25 * (a - b - c + d)};
    }
};

double squared_norm(double wavelet, std::size_t level) {
    // Its squared amplitude times its texels.
    return wavelet * wavelet * std::pow(4.0, static_cast<double>(level));
}

/// Squared norms of all wavelets, in ascending order.
std::vector<double> squares_of(std::size_t side, const std::vector<float>& texels) {
    std::vector<double> squares;
    for (std::size_t f = 0; f < 6; ++f) {
        const Pyramid p(side, texels.data() + f * side * side);
        for (std::size_t level = 1; level < p.sides.size(); ++level) {
            for (std::size_t y = 0; y < p.sides[level]; ++y) {
                for (std::size_t x = 0; x < p.sides[level]; ++x) {
                    for (const double w : p.wavelets(level, x, y)) squares.push_back(squared_norm(w, level));
                }
            }
        }
    }
    std::sort(squares.begin(), squares.end());
    return squares;
}

std::size_t count_within(const std::vector<double>& squares, double most_error) {
    double sum = 0.0;
    std::size_t count = 0;
    while (count < squares.size() && sum + squares[count] <= most_error * most_error) sum += squares[count++];
    return count;
}

}  // namespace

HaarCube HaarCube::within(std::size_t side, const std::vector<float>& texels, double most_error) {
    const std::vector<double> squares = squares_of(side, texels);
    return HaarCube(side, texels, squares, count_within(squares, most_error));
}

HaarCube HaarCube::of_terms(std::size_t side, const std::vector<float>& texels, std::size_t most_terms) {
    const std::vector<double> squares = squares_of(side, texels);
    const std::size_t kept = most_terms > 6 ? std::min(most_terms - 6, squares.size()) : 0;
    return HaarCube(side, texels, squares, squares.size() - kept);
}

HaarCube::HaarCube(std::size_t side, const std::vector<float>& texels, const std::vector<double>& squares,
                   std::size_t left_out)
    : side_(side) {
    const double least = left_out < squares.size() ? squares[left_out] : std::numeric_limits<double>::infinity();
    // Of those that are just as large, as many as are left.
    auto equal_left = static_cast<std::size_t>(std::upper_bound(squares.begin(), squares.end(), least) -
                                               squares.begin()) -
                      left_out;
    for (std::size_t f = 0; f < 6; ++f) {
        const Pyramid p(side, texels.data() + f * side * side);
        mean_[f] = static_cast<float>(p.means.back()[0]);
        ++terms_;
        const std::function<std::uint32_t(std::size_t, std::size_t, std::size_t)> build =
            [&](std::size_t level, std::size_t x, std::size_t y) -> std::uint32_t {
            if (level == 0) return 0;
            Node node;
            bool is_needed = false;
            std::array<double, 3> w = p.wavelets(level, x, y);
            for (double& v : w) {
                const double square = squared_norm(v, level);
                const bool is_kept = square > 0 && (square > least || (square == least && equal_left > 0));
                if (is_kept && square == least) --equal_left;
                if (is_kept) {
                    ++terms_;
                    is_needed = true;
                } else {
                    v = 0;
                }
            }
            node.right = static_cast<float>(w[0]);
            node.down = static_cast<float>(w[1]);
            node.diagonal = static_cast<float>(w[2]);
            for (std::size_t q = 0; q < 4; ++q) {
                node.child[q] = build(level - 1, 2 * x + q % 2, 2 * y + q / 2);
                is_needed = is_needed || node.child[q] != 0;
            }
            if (!is_needed) return 0;
            nodes_.push_back(node);
            return static_cast<std::uint32_t>(nodes_.size() - 1);
        };
        root_[f] = build(p.sides.size() - 1, 0, 0);
    }
}

double HaarCube::product(const HaarCube& a, const HaarCube& b, std::uint32_t of_a, std::uint32_t of_b, double area) {
    if (of_a == 0 || of_b == 0) return 0.0;  // wavelets of the one alone have no product with a constant
    const Node &x = a.nodes_[of_a], &y = b.nodes_[of_b];
    double sum = area * static_cast<double>(x.right * y.right + x.down * y.down + x.diagonal * y.diagonal);
    for (std::size_t q = 0; q < 4; ++q) sum += product(a, b, x.child[q], y.child[q], 0.25 * area);
    return sum;
}

double HaarCube::sum_of_products(const HaarCube& a, const HaarCube& b) {
    const auto area = static_cast<double>(a.side_ * a.side_);
    double sum = 0;
    for (std::size_t f = 0; f < 6; ++f) {
        sum += area * static_cast<double>(a.mean_[f]) * static_cast<double>(b.mean_[f]) +
               product(a, b, a.root_[f], b.root_[f], area);
    }
    return sum;
}

double HaarCube::product(const HaarCube& a, const HaarCube& b, const HaarCube& c,
                         const std::array<std::uint32_t, 3>& nodes, const std::array<float, 3>& means, double area) {
    if ((nodes[0] | nodes[1] | nodes[2]) == 0) {
        return area * static_cast<double>(means[0]) * static_cast<double>(means[1]) * static_cast<double>(means[2]);
    }
    const Node &x = a.nodes_[nodes[0]], &y = b.nodes_[nodes[1]], &z = c.nodes_[nodes[2]];
    double sum = 0;
    for (std::size_t q = 0; q < 4; ++q) {
        const auto at = [q](const Node& n, float mean) {
            return mean + sign_x[q] * n.right + sign_y[q] * n.down + sign_x[q] * sign_y[q] * n.diagonal;
        };
        sum += product(a, b, c, {x.child[q], y.child[q], z.child[q]},
                       {at(x, means[0]), at(y, means[1]), at(z, means[2])}, 0.25 * area);
    }
    return sum;
}

double HaarCube::sum_of_products(const HaarCube& a, const HaarCube& b, const HaarCube& c) {
    double sum = 0;
    for (std::size_t f = 0; f < 6; ++f) {
        sum += product(a, b, c, {a.root_[f], b.root_[f], c.root_[f]}, {a.mean_[f], b.mean_[f], c.mean_[f]},
                       static_cast<double>(a.side_ * a.side_));
    }
    return sum;
}

std::vector<float> HaarCube::texels() const {
    std::vector<float> result(6 * side_ * side_);
    const std::function<void(std::size_t, std::uint32_t, float, std::size_t, std::size_t, std::size_t)> fill =
        [&](std::size_t face, std::uint32_t n, float mean, std::size_t x, std::size_t y, std::size_t size) {
            if (size == 1) {
                result[face * side_ * side_ + y * side_ + x] = mean;
                return;
            }
            const Node node = nodes_[n];
            for (std::size_t q = 0; q < 4; ++q) {
                const float value = mean + sign_x[q] * node.right + sign_y[q] * node.down +
                                    sign_x[q] * sign_y[q] * node.diagonal;
                fill(face, node.child[q], value, x + q % 2 * size / 2, y + q / 2 * size / 2, size / 2);
            }
        };
    for (std::size_t f = 0; f < 6; ++f) fill(f, root_[f], mean_[f], 0, 0, side_);
    return result;
}

}  // namespace benchmark
