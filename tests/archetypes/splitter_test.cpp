#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/tree/build/divide.hpp>
#include <lightcuts/tree/validate.hpp>
#include "archetypes/archetypes.hpp"

namespace lightcuts::test {
namespace {

/// Splits sets of so many dimensions, as they are, and does nothing else.
template <std::size_t Dimensions>
class LeastSplitter : Pinned {
public:
    LeastSplitter() : Pinned(0) {}
    Split<Dimensions> split(const BuildRange<Dimensions>& range, const NormalizedSpace&) const {
        return split_at(range, (range.items.size() + 2) / 3);
    }
};

// Each lacks one thing that the concept asks for.
struct SplitsNothing {};
struct SplitsOnlyOnce {
    Split<3> split(const BuildRange<3>& range, const NormalizedSpace&) { return split_at(range, 1); }
};
struct SplitsIntoPairs {
    std::pair<BuildRange<3>, BuildRange<3>> split(const BuildRange<3>& range, const NormalizedSpace&) const {
        return {range, range};
    }
};
struct SplitsAnywhere {
    Split<3> split(const BuildRange<3>& range) const { return split_at(range, 1); }
};
static_assert(Splitter<LeastSplitter<3>, 3> && Splitter<LeastSplitter<6>, 6>);
static_assert(!Splitter<LeastSplitter<3>, 6> && !Splitter<LeastSplitter<6>, 3>);
static_assert(!Splitter<SplitsNothing, 3> && !Splitter<SplitsOnlyOnce, 3> && !Splitter<SplitsIntoPairs, 3> &&
              !Splitter<SplitsAnywhere, 3>);
static_assert(Splitter<Binned, 3> && Splitter<Binned, 6> && Splitter<LongestAxis, 3> && Splitter<LongestAxis, 6>);

template <class Item, std::size_t Dimensions>
void expect_trees(const std::vector<Item>& items) {
    const LeastSplitter<Dimensions> splitter;
    const ClusterTree tree = divide(items, splitter);
    EXPECT_NO_THROW(validate(tree));
    EXPECT_EQ(tree.leaf_count(tree.left(tree.root())), (items.size() + 2) / 3);

    const NormalizedSpace space;
    std::vector<BuildItem<Dimensions>> all;
    for (const Item& item : items) all.push_back(build_item(item, static_cast<std::uint32_t>(all.size()), space));
    DivideScratch<Dimensions> scratch;
    ClusterTree again;
    divide_into(std::span(all), splitter, space, scratch, again);
    EXPECT_EQ(again, tree);
}

TEST(Archetypes, DivideBySplittersThatOnlySplit) {
    expect_trees<PointItem, 3>(std::vector<PointItem>(100, PointItem{{1, 2, 3}, 1}));
    expect_trees<OrientedItem, 6>(std::vector<OrientedItem>(100, OrientedItem{{1, 2, 3}, {0, 0, 1}, 1}));
}

}  // namespace
}  // namespace lightcuts::test
