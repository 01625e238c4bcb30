#include <cstddef>
#include <cstdint>
#include <memory>
#include <ranges>
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

/// Pieces as a range that is no span, but lasts as one does.
struct BorrowedPieces {
    const std::vector<Piece>* all;
    const Piece* begin() const { return all->data(); }
    const Piece* end() const { return all->data() + all->size(); }
};

}  // namespace
}  // namespace lightcuts::test

template <>
inline constexpr bool std::ranges::enable_borrowed_range<lightcuts::test::BorrowedPieces> = true;

namespace lightcuts::test {
namespace {

/// A function whose pieces come as something that becomes a span, and whose values can only be indexed.
class LeastFunction : Pinned {
public:
    struct Values {
        const Opaque* first;
        const Opaque& operator[](std::size_t i) const { return first[i]; }
    };
    LeastFunction() : Pinned(0) {}
    BorrowedPieces pieces() const { return {&pieces_}; }
    Values values() const { return {values_}; }

private:
    std::vector<Piece> pieces_{{0, 1}, {1, 2}};
    Opaque values_[2]{Opaque(3), Opaque(4)};
};
static_assert(PiecewiseFunction<LeastFunction> && !DeviatingFunction<LeastFunction>);

/// A function that refers to its pieces and to its values, which cannot be copied.
class LeastReferring : Pinned {
public:
    struct Values : Pinned {
        Values() : Pinned(0) {}
        const Opaque& operator[](std::size_t i) const { return all[i]; }
        Opaque all[2]{Opaque(5), Opaque(6)};
    };
    LeastReferring() : Pinned(0) {}
    const std::vector<Piece>& pieces() const { return pieces_; }
    const Values& values() const { return values_; }

private:
    std::vector<Piece> pieces_{{0, 1}, {1, 2}};
    Values values_;
};
static_assert(PiecewiseFunction<LeastReferring>);

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
struct WithPiecesThatVanish {
    std::vector<Piece> pieces() const;
    std::span<const float> values() const;
};
struct WithValuesThatVanish {
    std::span<const Piece> pieces() const;
    std::vector<float> values() const;
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
static_assert(!PiecewiseFunction<WithPiecesThatVanish> && PiecewiseFunction<WithValuesThatVanish>);
static_assert(PiecewiseFunction<WithoutDeviation> && !DeviatingFunction<WithoutDeviation>);
static_assert(PiecewiseFunction<NotSaying> && !DeviatingFunction<NotSaying>);
static_assert(PiecewiseValue<float> && PiecewiseValue<double> && PiecewiseValue<Bands> && !PiecewiseValue<Opaque>);

// What algebra asks of types.
template <class F>
concept Mergeable = requires(std::span<const F> functions, MergeScratch<float> scratch) {
    merge(functions, scratch, [](std::uint32_t, std::uint32_t, std::span<const float>) {});
};
template <class R>
concept Summable = requires(const PiecewiseConstant<float>& f, R (*op)(float)) {
    sum_over_leaves(op, f);
};
template <class V>
concept Interpolated = requires(PiecewiseConstant<V>& out, std::span<const float> weights,
                                std::span<const PiecewiseConstant<float>> functions, MergeScratch<float>& scratch) {
    interpolate(out, weights, functions, scratch);
};
static_assert(Mergeable<PiecewiseConstant<float>> && !Mergeable<WithValuesThatVanish>);
static_assert(Summable<float> && Summable<double> && Summable<Bands> && !Summable<bool> && !Summable<int>);
static_assert(Interpolated<float> && !Interpolated<double>);

TEST(Archetypes, MergeOfFunctionsThatCanOnlyBeLookedAt) {
    const LeastFunction f, g;
    int sum = 0;
    merge([&](std::uint32_t, std::uint32_t, const Opaque& a, const Opaque& b) { sum += a.id() * b.id(); }, f, g);
    EXPECT_EQ(sum, 9 + 16);
    const LeastReferring h;
    merge([&](std::uint32_t, std::uint32_t, const Opaque& a, const Opaque& b) { sum += a.id() * b.id(); }, f, h);
    EXPECT_EQ(sum, 9 + 16 + 15 + 24);
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
