#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/piecewise/algebra.hpp>
#include <lightcuts/piecewise/approximate.hpp>
#include <lightcuts/piecewise/bounded_product.hpp>
#include "piecewise/functions.hpp"
#include "support/allocations.hpp"

namespace lightcuts::test {
namespace {

TEST(PiecewiseAllocation, DoesNotHappenOnceWarm) {
    Random random(1);
    const ClusterTree tree = random_tree(random, 2000);
    const auto a = random_function(random, 2000, Kind::binary), b = random_function(random, 2000, Kind::uniform);
    std::vector<Moments<1>> of_a, of_b;
    std::vector<PiecewiseConstant<float>> f(3);
    PiecewiseConstant<float> out;
    OrderedApproximation<float> ordered;
    MergeScratch<float> scratch;
    const std::vector<float> weights{0.2f, 0.3f, 0.5f};
    double sink = 0;
    const auto everything = [&] {
        refit_moments(tree, of_a, [&](std::uint32_t i) { return a[i]; });
        refit_moments(tree, of_b, [&](std::uint32_t i) { return b[i]; });
        approximate(tree, of_a, 1.0, f[0], true);
        ordered.start(tree, of_b);
        ordered.refine_by_error(2.0, 100);
        ordered.store(f[1], true);
        ordered.refine_to_total_error(1.0);
        ordered.refine_by_value(500);
        ordered.store(f[2], true);
        sink += bounded_product(f[0], f[1]).value + bounded_product(f[0], f[1], f[2]).value;
        sink += sum_of_products(f[0], f[1], f[2], f[0], f[1], f[2], f[0], f[1]);
        product(out, f[0], f[1], f[2]);
        interpolate(out, std::span<const float>(weights), std::span<const PiecewiseConstant<float>>(f), scratch);
    };
    everything();
    const std::size_t before = allocations;
    everything();
    EXPECT_EQ(allocations, before);
    EXPECT_GT(sink, 0.0);
}

}  // namespace
}  // namespace lightcuts::test
