#include <lightcuts/piecewise/cut_file.hpp>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#if __has_include(<sys/stat.h>)
#include <sys/stat.h>
#endif

#include <gtest/gtest.h>

#include <lightcuts/piecewise/bounded_product.hpp>
#include <lightcuts/piecewise/mapped_file.hpp>
#include <lightcuts/piecewise/tree_file.hpp>
#include "piecewise/functions.hpp"
#include "support/temporary_folder.hpp"

namespace lightcuts::test {
namespace {

using Function = PiecewiseConstant<float>;
using Bytes = std::vector<std::byte>;

constexpr CutEncoding encodings[]{{ValueBits::eight, false},  {ValueBits::eight, true}, {ValueBits::sixteen, false},
                                  {ValueBits::sixteen, true}, {ValueBits::full, false}, {ValueBits::full, true}};

struct Stored {
    std::vector<float> values;
    std::vector<Moments<1>> of;
    Function cut;

    Stored(Random& random, const ClusterTree& tree, Kind kind)
        : values(random_function(random, static_cast<std::uint32_t>(tree.item_count()), kind)),
          of(moments(tree, [this](std::uint32_t i) { return values[i]; })),
          cut(means_on<float>(tree, of, random_cut(random, tree, random.between(0.0, 0.5)))) {}
};

std::string refusal_of(const auto& call) {
    try {
        call();
    } catch (const invalid_input& error) {
        const std::string said = error.what();
        EXPECT_FALSE(said.empty());
        EXPECT_EQ(said.find('\n'), std::string::npos);
        return said;
    }
    return "";
}

TEST(Compact, KeepsNodesAndValuesWithinItsError) {
    Random random(1);
    for (int trial = 0; trial < 200; ++trial) {
        const ClusterTree tree = random_tree(random, 1 + static_cast<std::uint32_t>(random.below(200)),
                                             trial % 3 == 0 ? 5 : 2);
        const Stored s(random, tree, all_kinds[random.below(std::size(all_kinds))]);
        for (const CutEncoding& encoding : encodings) {
            Bytes bytes;
            encode(s.cut, encoding, bytes);
            Function found;
            decode(bytes, encoding, tree, found);
            ASSERT_TRUE(
                std::equal(found.pieces().begin(), found.pieces().end(), s.cut.pieces().begin(), s.cut.pieces().end()));
            const auto [least, largest] = std::minmax_element(s.cut.values().begin(), s.cut.values().end());
            const float most = quantization_error(*least, *largest, encoding.bits);
            for (std::size_t i = 0; i < found.size(); ++i) {
                const double error = std::abs(static_cast<double>(found.values()[i]) -
                                              static_cast<double>(s.cut.values()[i]));
                EXPECT_LE(error, static_cast<double>(most));
                if (s.cut.values()[i] == *least || s.cut.values()[i] == *largest) { EXPECT_EQ(error, 0.0); }
            }
            const double steps = encoding.bits == ValueBits::eight ? 255 : 65535;
            EXPECT_LE(static_cast<double>(most), 0.51 * static_cast<double>(*largest - *least) / steps +
                                                     1e-6 * std::abs(static_cast<double>(*largest)) +
                                                     1e-6 * std::abs(static_cast<double>(*least)) + 1e-37);
        }
    }
}

// Where sums in double would lose one beside the other.
TEST(Compact, KeepsTheLeastAndTheLargestValueExactly) {
    Random random(10);
    const ClusterTree tree = random_tree(random, 2);
    for (const auto& [a, b] : {std::pair{-1e30f, 1.25f}, std::pair{0.1f, 0.3f}, std::pair{3e38f, -3e38f}}) {
        for (const ValueBits bits : {ValueBits::eight, ValueBits::sixteen, ValueBits::full}) {
            Function f, found;
            assign<float>(tree, std::vector<std::uint32_t>{0, 1}, std::vector<float>{a, b}, f);
            Bytes bytes;
            encode(f, {bits, false}, bytes);
            decode(bytes, {bits, false}, tree, found);
            EXPECT_EQ(at_leaves(found), at_leaves(f));
        }
    }
}

// Deviations of what was rounded once more still bound the function.
TEST(Compact, DeviationsHoldForStoredValues) {
    Random random(2);
    for (int trial = 0; trial < 300; ++trial) {
        const ClusterTree tree = random_tree(random, 2 + static_cast<std::uint32_t>(random.below(100)));
        const Stored a(random, tree, all_kinds[random.below(std::size(all_kinds))]);
        const Stored b(random, tree, all_kinds[random.below(std::size(all_kinds))]);
        long double exact = 0;
        for (std::size_t i = 0; i < a.values.size(); ++i) {
            exact += static_cast<long double>(a.values[i]) * static_cast<long double>(b.values[i]);
        }
        for (const CutEncoding& encoding : encodings) {
            if (!encoding.deviations) continue;
            Function f, g;
            Bytes bytes;
            encode(a.cut, encoding, bytes);
            decode(bytes, encoding, tree, f);
            bytes.clear();
            encode(b.cut, encoding, bytes);
            decode(bytes, encoding, tree, g);
            const BoundedSum found = bounded_product(f, g);
            EXPECT_LE(std::abs(static_cast<long double>(found.value) - exact),
                      static_cast<long double>(found.error_bound) * (1 + 1e-15L));
            std::uint32_t leaf = 0;
            for (std::size_t i = 0; i < f.size(); ++i) {
                long double squares = 0, sum = 0;
                for (; leaf < f.pieces()[i].leaf_end(); ++leaf) {
                    const long double d = static_cast<long double>(a.values[leaf]) -
                                          static_cast<long double>(f.values()[i]);
                    squares += d * d;
                    sum += d;
                }
                EXPECT_LE(std::sqrt(squares), static_cast<long double>(f.deviation(i).norm));
                EXPECT_LE(std::abs(sum), f.leaves(i) * static_cast<long double>(f.deviation(i).offset));
            }
        }
    }
}

TEST(Compact, TakesThreeBytesAPieceAndLargeSteps) {
    Random random(3);
    const ClusterTree tree = random_tree(random, 200'000);
    // One leaf, then the siblings on its way to the root: some are farther apart than 16 bits can say.
    std::vector<std::uint32_t> nodes{0};
    for (std::uint32_t n = 0; n < tree.root();) {
        std::uint32_t parent = n + 1;
        while (tree.left_leaf(parent) != 0) ++parent;
        nodes.push_back(parent - 1);
        n = parent;
    }
    std::sort(nodes.begin(), nodes.end());
    const std::vector<float> values(nodes.size(), 0.25f);
    Function f, found;
    assign<float>(tree, nodes, values, f);
    std::size_t wide = 0;
    for (std::size_t i = 1; i < nodes.size(); ++i) wide += nodes[i] - nodes[i - 1] > 65535 ? 1 : 0;
    ASSERT_GT(wide, 0u);
    Bytes bytes;
    encode(f, {ValueBits::eight, false}, bytes);
    EXPECT_EQ(bytes.size(), 24 + 3 * f.size() + 4 * wide);
    decode(bytes, {ValueBits::eight, false}, tree, found);
    EXPECT_EQ(at_leaves(found), at_leaves(f));
}

std::size_t count_files(const TemporaryFolder& folder) {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder.path()), {}));
}

static_assert(std::is_constructible_v<CutFile, Bytes&, ClusterTree&>);
static_assert(!std::is_constructible_v<CutFile, Bytes&, ClusterTree>);

TEST(CutFile, OfThousandsIsMapped) {
    const TemporaryFolder folder;
    Random random(4);
    const ClusterTree tree = random_tree(random, 300);
    CutFileWriter writer(tree, {ValueBits::full, true});
    std::vector<Stored> stored;
    for (int i = 0; i < 2000; ++i) {
        stored.emplace_back(random, tree, Kind::uniform);
        if (i % 2 == 0) {
            writer.append(stored.back().cut);
        } else {
            Bytes own;
            encode(stored.back().cut, writer.encoding(), own);
            writer.append_encoded(own);
        }
    }
    write_bytes(folder.path() / "cuts", writer.bytes());
    EXPECT_EQ(count_files(folder), 1u);
    MappedFile unused(folder.path() / "cuts");
    const MappedFile mapped = std::move(unused);
    const CutFile file(mapped.bytes(), tree);
    ASSERT_EQ(file.size(), 2000u);
    Function f;
    for (std::size_t i = 0; i < file.size(); ++i) {
        file.read(i, f);
        EXPECT_EQ(at_leaves(f), at_leaves(stored[i].cut));
        EXPECT_GE(f.deviation(0).norm, stored[i].cut.deviation(0).norm);
    }
    // A file is replaced while it is mapped.
    write_bytes(folder.path() / "cuts", CutFileWriter(tree).bytes());
    file.read(7, f);
    EXPECT_EQ(at_leaves(f), at_leaves(stored[7].cut));
    EXPECT_EQ(CutFile(read_bytes(folder.path() / "cuts"), tree).size(), 0u);
}

TEST(CutFile, IsRefusedWhereItIsDamagedCutShortOrForeign) {
    Random random(5);
    const ClusterTree tree = random_tree(random, 60), other = random_tree(random, 60);
    CutFileWriter writer(tree, {ValueBits::eight, true});
    for (int i = 0; i < 5; ++i) writer.append(Stored(random, tree, Kind::uniform).cut);
    const Bytes good = writer.bytes();
    const auto read = [&](const Bytes& bytes, const ClusterTree& t) {
        return refusal_of([&] {
            const CutFile file(bytes, t);
            Function f;
            for (std::size_t i = 0; i < file.size(); ++i) file.read(i, f);
        });
    };
    EXPECT_EQ(read(good, tree), "");
    EXPECT_NE(read(good, other).find("is of another tree"), std::string::npos);
    for (std::size_t size = 0; size < good.size(); ++size) {
        EXPECT_NE(read(Bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(size)), tree), "") << size;
    }
    for (std::size_t i = 0; i < good.size(); ++i) {
        for (const int bit : {0, 3, 7}) {
            Bytes bad = good;
            bad[i] ^= static_cast<std::byte>(1 << bit);
            EXPECT_NE(read(bad, tree), "") << i;
        }
    }
    Bytes longer = good;
    longer.push_back({});
    EXPECT_NE(read(longer, tree).find("1 bytes too many"), std::string::npos);
    Bytes swapped = good;
    std::reverse(swapped.begin() + 12, swapped.begin() + 16);
    EXPECT_NE(read(swapped, tree).find("in the other order"), std::string::npos);
    Bytes newer = good;
    newer[8] = std::byte{2};
    EXPECT_NE(read(newer, tree).find("is of version 2, not 1"), std::string::npos);
    EXPECT_NE(read(tree_file(tree), tree).find("another kind of file"), std::string::npos);
}

// What no checksum can notice: a cut of another tree, or no cut at all, written with care.
TEST(CutFile, ChecksCutsAgainstTheTree) {
    Random random(6);
    const ClusterTree tree = random_tree(random, 60), other = random_tree(random, 90);
    for (int trial = 0; trial < 200; ++trial) {
        const Stored s(random, other, Kind::uniform);
        Bytes bytes;
        encode(s.cut, {}, bytes);
        Function f;
        if (refusal_of([&] { decode(bytes, {}, tree, f); }).empty()) { EXPECT_NO_THROW(validate(tree, f)); }
    }
    Function bad;
    bad.append({tree.root(), 60}, std::nanf(""));
    Bytes bytes;
    EXPECT_NE(refusal_of([&] { encode(bad, {}, bytes); }).find("not finite"), std::string::npos);
    EXPECT_TRUE(bytes.empty());
    bad.values()[0] = 1.0f;
    EXPECT_NE(refusal_of([&] {
                  encode(bad, {ValueBits::eight, true}, bytes);
              }).find("no deviations"),
              std::string::npos);
}

// Bytes of a cut whose checksum is mended after they were changed.
void mend(Bytes& bytes) {
    const auto sum = static_cast<std::uint32_t>(detail::checksum(std::span(bytes).subspan(4)));
    for (std::size_t i = 0; i < 4; ++i) bytes[i] = static_cast<std::byte>(sum >> (8 * i) & 0xffu);
}

TEST(Compact, RefusesNodesThatDescend) {
    Bytes bytes;
    for (const std::uint32_t second : {2u, 5u}) {
        Function f;
        f.append({5, 3}, 1.0f);
        f.append({second, 5}, 2.0f);
        EXPECT_NE(refusal_of([&] { encode(f, {}, bytes); }).find("piece 1, node " + std::to_string(second)),
                  std::string::npos);
        EXPECT_TRUE(bytes.empty());
    }
}

TEST(Compact, LeavesNoHalfFunctionBehind) {
    Random random(11);
    const ClusterTree tree = random_tree(random, 12);
    const Stored s(random, tree, Kind::uniform);
    Function f = means_on<float>(tree, s.of, random_cut(random, tree, 0.0));
    for (const CutEncoding& encoding : encodings) {
        Bytes bytes;
        encode(f, encoding, bytes);
        Bytes bad = bytes;
        bad[24 + 2 * f.size() - 2] = std::byte{200};  // the last step
        mend(bad);
        Function out = f;
        EXPECT_NE(refusal_of([&] { decode(bad, encoding, tree, out); }), "");
        EXPECT_TRUE(out.empty());
        if (!encoding.deviations) continue;
        bad = bytes;
        bad[bad.size() - 1] = bad[bad.size() - 2] = std::byte{0xff};  // the last deviation: no number
        mend(bad);
        out = f;
        EXPECT_NE(refusal_of([&] { decode(bad, encoding, tree, out); }), "");
        EXPECT_TRUE(out.empty());
        EXPECT_FALSE(out.has_deviations());
    }
}

TEST(TreeFile, KeepsTheTreeAndItsSummaries) {
    const TemporaryFolder folder;
    Random random(7);
    for (int trial = 0; trial < 20; ++trial) {
        const ClusterTree tree = random_tree(random, static_cast<std::uint32_t>(random.below(300)),
                                             trial % 2 == 0 ? 2 : 6);
        const auto values = random_function(random, static_cast<std::uint32_t>(tree.item_count()), Kind::uniform);
        const auto of = moments(tree, [&](std::uint32_t i) { return values[i]; });
        write_bytes(folder.path() / "tree", tree_file(tree, std::span<const Moments<1>>(of), 42));
        const MappedFile mapped(folder.path() / "tree");
        const auto found = read_tree<Moments<1>>(mapped.bytes(), 42);
        EXPECT_EQ(found.tree, tree);
        ASSERT_EQ(found.summaries.size(), of.size());
        for (std::size_t n = 0; n < of.size(); ++n) {
            EXPECT_EQ(found.summaries[n].mean, of[n].mean);
            EXPECT_EQ(found.summaries[n].squared_deviation, of[n].squared_deviation);
        }
        EXPECT_EQ(read_tree(tree_file(tree)).tree, tree);
        EXPECT_EQ(fingerprint(found.tree), fingerprint(tree));
    }
    // A tree that leaves items out.
    const ClusterTree some({ClusterTree::leaf_word(4), ClusterTree::leaf_word(1), 0}, 9);
    EXPECT_EQ(read_tree(tree_file(some)).tree, some);
}

TEST(TreeFile, IsRefusedWhereItIsDamagedCutShortOrForeign) {
    Random random(8);
    const ClusterTree tree = random_tree(random, 20);
    const std::vector<float> summaries(tree.size(), 1.0f);
    const Bytes good = tree_file(tree, std::span<const float>(summaries), 3);
    EXPECT_EQ(refusal_of([&] { read_tree<float>(good, 3); }), "");
    EXPECT_NE(refusal_of([&] { read_tree<float>(good, 4); }).find("tag 3"), std::string::npos);
    EXPECT_NE(refusal_of([&] { read_tree<double>(good, 3); }).find("summaries of 4 bytes"), std::string::npos);
    EXPECT_NE(refusal_of([&] { read_tree(good, 3); }), "");
    for (std::size_t i = 0; i < good.size(); ++i) {
        EXPECT_NE(refusal_of([&] { read_tree<float>(std::span(good).first(i), 3); }), "") << i;
        Bytes bad = good;
        bad[i] ^= std::byte{4};
        EXPECT_NE(refusal_of([&] { read_tree<float>(bad, 3); }), "") << i;
    }
    // Whole, but no tree.
    const ClusterTree wrong({ClusterTree::leaf_word(0), ClusterTree::leaf_word(0), 0}, 2);
    EXPECT_NE(refusal_of([&] { read_tree(tree_file(wrong)); }).find("item 0 occurs twice"), std::string::npos);
    const std::vector<float> few(3);
    EXPECT_NE(refusal_of([&] { tree_file(tree, std::span<const float>(few)); }), "");
}

// Most items are left out, so that they are sorted.
TEST(TreeFile, FindsItemsThatOccurTwiceAmongManyLeftOut) {
    constexpr std::uint32_t a = ClusterTree::leaf_word(900'000'000), b = ClusterTree::leaf_word(7);
    const ClusterTree twice({b, a, 0, a, b, 3, 0}, ClusterTree::max_items);
    EXPECT_NE(refusal_of([&] { read_tree(tree_file(twice)); }).find("node 3: item 900000000 occurs twice"),
              std::string::npos);
    const ClusterTree beyond({b, a, 0}, 900'000'000);
    EXPECT_NE(refusal_of([&] { read_tree(tree_file(beyond)); }).find("out of range"), std::string::npos);
}

TEST(FileBytes, LeaveNoHalfWrittenFileBehind) {
    const TemporaryFolder folder;
    const Bytes bytes(100);
    std::filesystem::create_directory(folder.path() / "taken");
    for (const char* name : {"taken", "missing/file"}) {
        EXPECT_NE(refusal_of([&] { write_bytes(folder.path() / name, bytes); }).find(name), std::string::npos);
    }
    EXPECT_EQ(count_files(folder), 1u);
    EXPECT_NE(refusal_of([&] { MappedFile file(folder.path() / "missing"); }).find("missing"), std::string::npos);
    EXPECT_NE(refusal_of([&] { MappedFile file(folder.path()); }), "");
    write_bytes(folder.path() / "empty", {});
    EXPECT_TRUE(MappedFile(folder.path() / "empty").bytes().empty());
    Random random(9);
    const ClusterTree tree = random_tree(random, 5);
    const MappedFile empty(folder.path() / "empty");
    EXPECT_NE(refusal_of([&] { CutFile(empty.bytes(), tree); }), "");
}

#if __has_include(<sys/stat.h>)
TEST(FileBytes, DoNotWaitForPipes) {
    const TemporaryFolder folder;
    const std::filesystem::path pipe = folder.path() / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_NE(refusal_of([&] { MappedFile file(pipe); }).find("pipe"), std::string::npos);
    EXPECT_NE(refusal_of([&] { write_bytes(pipe, Bytes(10)); }).find("no regular file"), std::string::npos);
    EXPECT_TRUE(std::filesystem::is_fifo(pipe));
    EXPECT_EQ(count_files(folder), 1u);
}

TEST(FileBytes, AreWrittenToWhereLinksLead) {
    namespace fs = std::filesystem;
    const TemporaryFolder folder;
    fs::create_directory(folder.path() / "there");
    fs::create_symlink("there/file", folder.path() / "inner");
    fs::create_symlink(folder.path() / "inner", folder.path() / "outer");
    for (const std::size_t size : {10u, 20u}) {  // a file that is not there yet, and one that is
        write_bytes(folder.path() / "outer", Bytes(size));
        EXPECT_TRUE(fs::is_symlink(folder.path() / "outer") && fs::is_symlink(folder.path() / "inner"));
        EXPECT_EQ(fs::file_size(folder.path() / "there" / "file"), size);
    }
    EXPECT_EQ(count_files(folder), 3u);
    fs::create_symlink("self", folder.path() / "self");
    EXPECT_NE(refusal_of([&] { write_bytes(folder.path() / "self", Bytes(1)); }).find("leads nowhere"),
              std::string::npos);
}

TEST(FileBytes, KeepPermissions) {
    namespace fs = std::filesystem;
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "private";
    write_bytes(file, Bytes(1));
    for (const fs::perms p : {fs::perms::owner_read, fs::perms::owner_read | fs::perms::owner_write}) {
        fs::permissions(file, p);
        write_bytes(file, Bytes(2));
        EXPECT_EQ(fs::status(file).permissions(), p);
    }
}
#endif

}  // namespace
}  // namespace lightcuts::test
