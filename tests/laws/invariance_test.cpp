#include <cstdint>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/cut/lightcut.hpp>
#include "support/cut_results.hpp"
#include "support/scene.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;

template <class Forest, class M, class Oracle>
std::vector<CutResult<V>> shade_in_tiles(const Forest& forest, const std::vector<Receiver<M>>& receivers,
                                         const Oracle& oracle, const LightcutOptions& options, std::size_t tile) {
    std::vector<CutResult<V>> results(receivers.size());
    LightcutScratch<V> scratch;
    for (std::size_t begin = 0; begin < receivers.size(); begin += tile) {
        const std::size_t count = std::min(tile, receivers.size() - begin);
        shade(forest, std::span<const Receiver<M>>(receivers).subspan(begin, count), oracle,
              std::span(results).subspan(begin, count), scratch, options);
    }
    return results;
}

TEST(Tiles, DoNotChangeABit) {
    Room<V> room(31);
    const auto omni = room.omni(500);
    const auto oriented = room.oriented(500);
    const LightTree a(omni);
    const LightTree b(oriented, {.representatives = 8});
    const LightForest forest(a, b);
    const Occluders occluders = room.occluders();
    const auto receivers = room.glossy_receivers(100);
    const BatchedOccluders batched{occluders, 0.2f};
    const ScalarOccluders scalar{occluders, 0.2f};
    for (const LightcutOptions& options : {LightcutOptions{.exhaustive_below = 0},
                                           LightcutOptions{.error_ratio = 0.005f, .max_cut = 90, .exhaustive_below = 0},
                                           LightcutOptions{.exhaustive_below = 0, .round_fraction = 1.0}}) {
        const auto one_by_one = shade_in_tiles(forest, receivers, batched, options, 1);
        for (const std::size_t tile : {2u, 7u, 64u, 100u}) {
            expect_same(one_by_one, shade_in_tiles(forest, receivers, batched, options, tile));
        }
        expect_same(one_by_one, shade_in_tiles(forest, receivers, scalar, options, 100));

        std::vector<CutResult<V>> single;
        for (const auto& receiver : receivers) single.push_back(shade(forest, receiver, batched, options));
        expect_same(one_by_one, single);

        std::vector<CutResult<V>> stepped;
        for (const auto& receiver : receivers) {
            Lightcut cut(forest, receiver, scalar, options);
            std::uint32_t size = 0;
            for (;;) {
                const CutResult<V> so_far = cut.result();
                EXPECT_GE(so_far.cut_size, size);
                size = so_far.cut_size;
                if (!cut.step()) break;
                EXPECT_EQ(cut.result().stop, StopReason::unfinished);
            }
            EXPECT_FALSE(cut.step()) << "a final cut stays final";
            stepped.push_back(cut.result());
        }
        expect_same(one_by_one, stepped);
    }
}

// The order of the answers is the order of the queries, and one call serves the whole tile.
TEST(Tiles, AskInOneBatchARound) {
    struct Counting {
        const Occluders& occluders;
        std::size_t& calls;
        std::size_t& rays;
        void many(std::span<const VisibilityQuery> queries, std::span<float> answers) const {
            ASSERT_EQ(queries.size(), answers.size());
            ASSERT_FALSE(queries.empty());
            ++calls;
            rays += queries.size();
            BatchedOccluders{occluders}.many(queries, answers);
        }
    };
    Room<V> room(32);
    const auto lights = room.omni(800);
    const LightTree tree(lights);
    const LightForest forest(tree);
    const Occluders occluders = room.occluders();
    const auto receivers = room.diffuse_receivers(64);
    std::size_t calls = 0, rays = 0;
    const auto results = shade_in_tiles(forest, receivers, Counting{occluders, calls, rays}, {}, 64);
    std::size_t total = 0;
    for (const auto& r : results) total += r.queries;
    EXPECT_EQ(rays, total);
    EXPECT_LT(calls, 60u) << "rounds of 64 receivers in lock-step";
    EXPECT_GT(rays / calls, 128u);
}

// A warm scratch gives what a cold one gives, whatever it was used for before.
TEST(Scratch, RemembersNothing) {
    Room<V> room(34);
    const auto lights = room.omni(300);
    const LightTree tree(lights);
    const LightForest forest(tree);
    const Occluders occluders = room.occluders();
    const BatchedOccluders oracle{occluders};
    const auto receivers = room.diffuse_receivers(20);
    const auto cold = shade_in_tiles(forest, receivers, oracle, {}, 20);
    LightcutScratch<V> scratch;
    std::vector<CutResult<V>> warm(receivers.size());
    for (int repeat = 0; repeat < 3; ++repeat) {
        for (std::size_t i = 0; i < receivers.size(); i += 4) {
            shade(forest, std::span(receivers).subspan(i, 4), oracle, std::span(warm).subspan(i, 4), scratch,
                  {.error_ratio = 0.3f});
        }
        shade(forest, std::span(receivers), oracle, std::span(warm), scratch);
        expect_same(cold, warm);
    }
}

}  // namespace
}  // namespace lightcuts::test
