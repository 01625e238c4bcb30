#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/piecewise/algebra.hpp>
#include <lightcuts/piecewise/approximate.hpp>
#include <lightcuts/piecewise/bounded_product.hpp>
#include "archetypes/archetypes.hpp"

namespace lightcuts::test {
namespace {

/// A value that can be looked at, and nothing else: merges do no arithmetic of their own.
class Opaque {
public:
    explicit Opaque(int id) : id_(id) {}
    Opaque(const Opaque&) = delete;
    Opaque& operator=(const Opaque&) = delete;
    int id() const { return id_; }

private:
    int id_;
};

/// A function whose pieces come as something that becomes a span, and whose values can only be indexed.
class LeastFunction : Pinned {
public:
    struct Values {
        const Opaque* first;
        const Opaque& operator[](std::size_t i) const { return first[i]; }
    };
    struct Pieces {
        const std::vector<Piece>* all;
        operator std::span<const Piece>() const { return *all; }
    };
    LeastFunction() : Pinned(0) {}
    Pieces pieces() const { return {&pieces_}; }
    Values values() const { return {values_}; }

private:
    std::vector<Piece> pieces_{{0, 1}, {1, 2}};
    Opaque values_[2]{Opaque(3), Opaque(4)};
};
static_assert(PiecewiseFunction<LeastFunction> && !DeviatingFunction<LeastFunction>);

/// A scalar function with deviations, computed where they are asked for.
class LeastDeviating : Pinned {
public:
    struct Values {
        float operator[](std::size_t i) const { return i == 0 ? 0.5f : 1.0f; }
    };
    LeastDeviating() : Pinned(0) {}
    std::span<const Piece> pieces() const { return pieces_; }
    Values values() const { return {}; }
    bool has_deviations() const { return true; }
    Deviation deviation(std::size_t) const { return {}; }

private:
    std::vector<Piece> pieces_{{0, 1}, {1, 2}};
};
static_assert(DeviatingFunction<LeastDeviating>);

// Each lacks one thing that the concepts ask for.
struct WithoutValues {
    std::span<const Piece> pieces() const;
};
struct WithoutPieces {
    std::span<const float> values() const;
};
struct WithoutDeviation {
    std::span<const Piece> pieces() const;
    std::span<const float> values() const;
    bool has_deviations() const;
};
struct NotSaying {
    std::span<const Piece> pieces() const;
    std::span<const float> values() const;
    Deviation deviation(std::size_t) const;
};
static_assert(!PiecewiseFunction<WithoutValues> && !PiecewiseFunction<WithoutPieces>);
static_assert(PiecewiseFunction<WithoutDeviation> && !DeviatingFunction<WithoutDeviation>);
static_assert(PiecewiseFunction<NotSaying> && !DeviatingFunction<NotSaying>);
static_assert(PiecewiseValue<float> && PiecewiseValue<double> && PiecewiseValue<Bands> && !PiecewiseValue<Opaque>);

TEST(Archetypes, MergeOfFunctionsThatCanOnlyBeLookedAt) {
    const LeastFunction f, g;
    int sum = 0;
    merge([&](std::uint32_t, std::uint32_t, const Opaque& a, const Opaque& b) { sum += a.id() * b.id(); }, f, g);
    EXPECT_EQ(sum, 9 + 16);
    // An operation that can be called once after the other, and not be copied.
    struct Op : Pinned {
        int* count;
        explicit Op(int* c) : Pinned(0), count(c) {}
        void operator()(std::uint32_t, std::uint32_t, const Opaque&) { ++*count; }
    };
    int count = 0;
    Op op(&count);
    merge(op, f);
    EXPECT_EQ(count, 2);
    EXPECT_EQ(sum_over_leaves([](const Opaque& a) { return static_cast<double>(a.id()); }, f), 7.0);
}

TEST(Archetypes, BoundedProductOfFunctionsThatComputeTheirDeviations) {
    const LeastDeviating f;
    EXPECT_EQ(bounded_product(f, f).value, 1.25);
    EXPECT_EQ(bounded_product(f, f, f).value, 1.125);
}

TEST(Archetypes, ApproximateValuesThatOnlyAddAndScale) {
    const ClusterTree tree({ClusterTree::leaf_word(0), ClusterTree::leaf_word(1), 0});
    const auto leaf = [](std::uint32_t i) { return Bands({1, 2, 3, 4, static_cast<float>(i)}); };
    const auto of = moments(tree, leaf);
    PiecewiseConstant<Bands> f, doubled;
    approximate(tree, of, 10.0, f, true);
    ASSERT_EQ(f.size(), 1u);
    EXPECT_EQ(f.values()[0][4], 0.5f);
    OrderedApproximation<Bands> ordered;
    ordered.start(tree, of);
    ordered.refine_by_error(0.0);
    ordered.store(f);
    ASSERT_EQ(f.size(), 2u);
    merged(
        doubled, [](const Bands& a, const Bands& b) -> Bands { return a + b; }, f, f);
    EXPECT_EQ(doubled.values()[1][4], 2.0f);
}

}  // namespace
}  // namespace lightcuts::test
