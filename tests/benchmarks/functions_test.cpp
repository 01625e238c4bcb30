#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "benchmarks/cube_map.hpp"
#include "benchmarks/haar.hpp"
#include "benchmarks/spherical_harmonics.hpp"

namespace {

using benchmark::CubeMap;
using benchmark::HaarCube;
using benchmark::SphericalHarmonics;

constexpr double pi = std::numbers::pi;

std::vector<double> harmonics_at(int order, const glm::dvec3& d) {
    const SphericalHarmonics harmonics(order);
    std::vector<double> values(harmonics.size());
    harmonics.evaluate(d, values);
    return values;
}

TEST(CubeMap, hasTexelsOfOneSolidAngle) {
    // The area of each texel by the triangles of a finer grid on it.
    constexpr std::size_t side = 8, finer = 16;
    for (std::size_t face = 0; face < 6; ++face) {
        for (std::size_t y = 0; y < side; ++y) {
            for (std::size_t x = 0; x < side; ++x) {
                const auto corner = [&](std::size_t i, std::size_t k) {
                    const auto at = [](std::size_t texel, std::size_t part) {
                        return 2.0 * static_cast<double>(texel * finer + part) / (side * finer) - 1.0;
                    };
                    return CubeMap::direction(face, at(x, i), at(y, k));
                };
                double area = 0.0;
                for (std::size_t i = 0; i < finer; ++i) {
                    for (std::size_t k = 0; k < finer; ++k) {
                        const glm::dvec3 a = corner(i, k), b = corner(i + 1, k), c = corner(i, k + 1),
                                         d = corner(i + 1, k + 1);
                        area += 0.5 * (glm::length(glm::cross(b - a, c - a)) + glm::length(glm::cross(b - d, c - d)));
                    }
                }
                EXPECT_NEAR(area, 4.0 * pi / (6.0 * side * side), 3e-5) << face << " " << x << " " << y;
            }
        }
    }
}

TEST(CubeMap, hasFacesThatMeetAtTheirEdges) {
    for (const double v : {-1.0, -0.4, 0.0, 0.7, 1.0}) {
        // The cube's edge between the faces of x and of y.
        const glm::dvec3 of_x = CubeMap::direction(0, 1.0, v), of_y = CubeMap::direction(2, 1.0, v);
        EXPECT_NEAR(glm::length(of_x - of_y), 0.0, 1e-12);
        EXPECT_NEAR(glm::length(of_x), 1.0, 1e-12);
    }
    EXPECT_NEAR(glm::length(CubeMap::direction(4, 0.0, 0.0) - glm::dvec3(0, 0, 1)), 0.0, 1e-12);
    EXPECT_NEAR(glm::length(CubeMap::direction(5, 1.0, 1.0) - glm::normalize(glm::dvec3(1, 1, -1))), 0.0, 1e-12);
}

TEST(SphericalHarmonics, areTheKnownOnes) {
    const glm::dvec3 d = glm::normalize(glm::dvec3(0.3, -0.5, 0.7));
    const std::vector<double> y = harmonics_at(4, d);
    EXPECT_NEAR(y[0], 0.5 / std::sqrt(pi), 1e-14);
    const double one = std::sqrt(3.0 / (4.0 * pi));
    EXPECT_NEAR(y[1], one * d.y, 1e-14);
    EXPECT_NEAR(y[2], one * d.z, 1e-14);
    EXPECT_NEAR(y[3], one * d.x, 1e-14);
    const double two = 0.5 * std::sqrt(15.0 / pi);
    EXPECT_NEAR(y[4], two * d.x * d.y, 1e-14);
    EXPECT_NEAR(y[5], two * d.y * d.z, 1e-14);
    EXPECT_NEAR(y[6], 0.25 * std::sqrt(5.0 / pi) * (3.0 * d.z * d.z - 1.0), 1e-14);
    EXPECT_NEAR(y[7], two * d.x * d.z, 1e-14);
    EXPECT_NEAR(y[8], 0.5 * two * (d.x * d.x - d.y * d.y), 1e-14);
    // Degree 3: m = 0, 2 and -3.
    EXPECT_NEAR(y[12], 0.25 * std::sqrt(7.0 / pi) * d.z * (5.0 * d.z * d.z - 3.0), 1e-14);
    EXPECT_NEAR(y[14], 0.25 * std::sqrt(105.0 / pi) * d.z * (d.x * d.x - d.y * d.y), 1e-14);
    EXPECT_NEAR(y[9], 0.25 * std::sqrt(35.0 / (2.0 * pi)) * d.y * (3.0 * d.x * d.x - d.y * d.y), 1e-14);
}

TEST(SphericalHarmonics, addUpToLegendresPolynomials) {
    // The sum over m of Y(a) Y(b) is (2 l + 1) / (4 pi) P_l(a . b), at any degree and also at the poles.
    constexpr int order = 96;
    const std::vector<glm::dvec3> directions = {{0, 0, 1},
                                                {0, 0, -1},
                                                {1, 0, 0},
                                                glm::normalize(glm::dvec3(1e-9, 0, 1)),
                                                glm::normalize(glm::dvec3(-0.2, 0.9, 0.4))};
    for (const glm::dvec3& a : directions) {
        for (const glm::dvec3& b : directions) {
            const std::vector<double> of_a = harmonics_at(order, a), of_b = harmonics_at(order, b);
            for (int l = 0; l < order; ++l) {
                double sum = 0.0;
                for (int at = l * l; at < (l + 1) * (l + 1); ++at) {
                    sum += of_a[static_cast<std::size_t>(at)] * of_b[static_cast<std::size_t>(at)];
                }
                const double cosine = glm::dot(a, b);
                double last = 0.0, legendre = 1.0;  // Bonnet's recurrence
                for (int k = 1; k <= l; ++k) {
                    const double next = ((2.0 * k - 1.0) * cosine * legendre - (k - 1.0) * last) / k;
                    last = legendre;
                    legendre = next;
                }
                EXPECT_NEAR(sum, (2.0 * l + 1.0) / (4.0 * pi) * legendre, 1e-9) << l;
            }
        }
    }
}

TEST(SphericalHarmonics, areOrthonormalOnTheCubeMap) {
    const CubeMap map(32);
    const SphericalHarmonics harmonics(8);
    std::vector<std::vector<float>> functions(harmonics.size());
    std::vector<double> values(harmonics.size());
    for (const glm::dvec3& d : map.directions()) {
        harmonics.evaluate(d, values);
        for (std::size_t k = 0; k < values.size(); ++k) functions[k].push_back(static_cast<float>(values[k]));
    }
    // Coefficients of harmonics are 1 for their own, but for the scale of sums over texels.
    const auto coefficients = benchmark::project(harmonics, map.directions(), functions);
    const double scale = std::sqrt(static_cast<double>(map.directions().size()) / (4.0 * pi));
    for (std::size_t i = 0; i < harmonics.size(); ++i) {
        for (std::size_t k = 0; k < harmonics.size(); ++k) {
            EXPECT_NEAR(static_cast<double>(coefficients[i][k]) / scale, i == k ? 1.0 : 0.0, 2e-3) << i << " " << k;
        }
        const std::vector<float> again = benchmark::expand(harmonics, map.directions(), coefficients[i]);
        for (std::size_t t = 0; t < again.size(); t += 101) EXPECT_NEAR(again[t], functions[i][t], 0.02) << i;
    }
}

TEST(SphericalHarmonics, multiplyAsTheirFunctionsDo) {
    // Functions of few frequencies: the dot product of coefficients is the sum over texels.
    const CubeMap map(32);
    std::vector<std::vector<float>> functions(2);
    double exact = 0.0;
    for (const glm::dvec3& d : map.directions()) {
        const double f = 1.0 + d.x + 0.5 * d.y * d.z, g = 2.0 - d.z + d.x * d.x;
        functions[0].push_back(static_cast<float>(f));
        functions[1].push_back(static_cast<float>(g));
        exact += f * g;
    }
    const auto coefficients = benchmark::project(SphericalHarmonics(6), map.directions(), functions);
    double sum = 0.0;
    for (std::size_t i = 0; i < coefficients[0].size(); ++i) {
        sum += static_cast<double>(coefficients[0][i]) * static_cast<double>(coefficients[1][i]);
    }
    EXPECT_NEAR(sum, exact, 1e-3 * exact);
}

TEST(HaarCube, multipliesAsItsTexelsDo) {
    constexpr std::size_t side = 8;
    std::mt19937 random(1);
    std::vector<std::vector<float>> texels(2);
    for (auto& t : texels) {
        for (std::size_t i = 0; i < 6 * side * side; ++i) {
            t.push_back(static_cast<float>(random() % 4) + (i % 5 == 0 ? 3.0f : 0.0f));
        }
    }
    for (const std::size_t terms : {6u, 40u, 384u}) {
        const HaarCube a = HaarCube::of_terms(side, texels[0], terms), b = HaarCube::of_terms(side, texels[1], terms);
        EXPECT_LE(a.terms(), terms);
        // All but those that are 0.
        if (terms < 100) { EXPECT_EQ(a.terms(), terms); }
        const std::vector<float> of_a = a.texels(), of_b = b.texels();
        double exact = 0.0;
        for (std::size_t i = 0; i < of_a.size(); ++i) {
            exact += static_cast<double>(of_a[i]) * static_cast<double>(of_b[i]);
        }
        EXPECT_NEAR(HaarCube::sum_of_products(a, b), exact, 1e-4 * exact) << terms;
    }
    // All wavelets make the function itself.
    const std::vector<float> whole = HaarCube::of_terms(side, texels[0], 384).texels();
    for (std::size_t i = 0; i < whole.size(); ++i) EXPECT_NEAR(whole[i], texels[0][i], 1e-4);
}

}  // namespace
