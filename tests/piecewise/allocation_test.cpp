#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/piecewise/algebra.hpp>
#include <lightcuts/piecewise/approximate.hpp>
#include <lightcuts/piecewise/bounded_product.hpp>
#include <lightcuts/piecewise/tree_file.hpp>
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

// Few bytes that speak of many items must not take memory for them.
TEST(PiecewiseAllocation, OfATreeFileIsThatOfItsBytes) {
    const ClusterTree tree({ClusterTree::leaf_word(1'000'000'000)}, ClusterTree::max_items);
    const auto bytes = tree_file(tree);
    EXPECT_EQ(bytes.size(), 64u);
    largest_allocation = 0;
    EXPECT_EQ(read_tree(bytes).tree, tree);
    EXPECT_LE(largest_allocation, 1000u);
}

/// A function whose values come by reference.
struct ByReference {
    std::vector<Piece> all;
    std::vector<float> numbers;
    const std::vector<Piece>& pieces() const { return all; }
    const std::vector<float>& values() const { return numbers; }
};

TEST(PiecewiseAllocation, DoesNotHappenToValuesByReference) {
    ByReference f;
    for (std::uint32_t i = 0; i < 1000; ++i) {
        f.all.push_back({2 * i, i + 1});
        f.numbers.push_back(1.0f);
    }
    const std::size_t before = allocations;
    const double sum = sum_of_products(f, f);
    EXPECT_EQ(allocations, before);
    EXPECT_EQ(sum, 1000.0);
}

// A root of many small basins, all of one error.
TEST(PiecewiseAllocation, OfARefinementIsThatOfItsPieces) {
    constexpr std::uint32_t basins = 60'000;
    std::vector<std::uint32_t> words;
    for (std::uint32_t i = 0; i < basins; ++i) {
        words.insert(words.end(), {ClusterTree::leaf_word(2 * i), ClusterTree::leaf_word(2 * i + 1), 3 * i});
    }
    words.push_back(0);
    const ClusterTree tree(words);
    const auto of = moments(tree, [](std::uint32_t i) { return static_cast<float>(i % 2); });
    OrderedApproximation<float> ordered;
    ordered.start(tree, of);
    largest_allocation = 0;
    EXPECT_EQ(ordered.refine_by_error(0.0, 100'001), StopReason::limit);
    EXPECT_EQ(ordered.size(), 100'001u);
    EXPECT_EQ(ordered.refine_by_error(0.0), StopReason::converged);
    EXPECT_EQ(ordered.size(), 2u * basins);
    EXPECT_LE(largest_allocation, 10'000'000u);
}

}  // namespace
}  // namespace lightcuts::test
