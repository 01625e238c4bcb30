#include <lightcuts/visibility/receiver_groups.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <gtest/gtest.h>
#include <glm/vec3.hpp>

#include <lightcuts/core/box.hpp>
#include <lightcuts/visibility/flood.hpp>

#include "support/random.hpp"

namespace lightcuts::test {
namespace {

/// Receivers on the faces of a cube, and some that have a normal of their own, or none.
std::vector<ReceiverBox> receivers(Random& random, std::size_t count) {
    const std::array<glm::vec3, 3> normals = {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, -1)};
    std::vector<ReceiverBox> all;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 at(random.in_box({-1, -1, -1}, {1, 1, 1}));
        ReceiverBox one{box_of(at), std::nullopt};
        const std::size_t kind = random.below(6);
        if (kind < 3) one.horizon = Horizon{normals[kind], box_of(at - 0.01f * normals[kind])};
        if (kind == 3) one.horizon = Horizon{glm::vec3(random.on_sphere()), box_of(at)};
        all.push_back(one);
    }
    return all;
}

TEST(ReceiverGroups, HoldEachReceiverOnce) {
    Random random(1);
    ReceiverGroups groups;
    for (const std::size_t count : {0u, 1u, 2u, 63u, 64u, 65u, 1000u}) {
        const std::vector<ReceiverBox> all = receivers(random, count);
        for (const std::size_t most : {1u, 2u, 16u, 64u, 5000u}) {
            groups.divide(all, most);
            std::vector<int> seen(count, 0);
            for (std::size_t g = 0; g < groups.size(); ++g) {
                EXPECT_GE(groups.members(g).size(), 1u);
                EXPECT_LE(groups.members(g).size(), most);
                for (const std::uint32_t i : groups.members(g)) ++seen[i];
            }
            EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), static_cast<std::ptrdiff_t>(count)) << count << most;
        }
    }
}

TEST(ReceiverGroups, AreInTheirBoxesWithTheirHorizons) {
    Random random(2);
    const std::vector<ReceiverBox> all = receivers(random, 2000);
    ReceiverGroups groups;
    groups.divide(all, 64);
    std::size_t with_horizon = 0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const ReceiverBox& box = groups.box(g);
        for (const std::uint32_t i : groups.members(g)) {
            EXPECT_TRUE(contains(box.box, all[i].box));
            if (!box.horizon) continue;
            ++with_horizon;
            ASSERT_TRUE(all[i].horizon);
            EXPECT_EQ(all[i].horizon->normal, box.horizon->normal);
            EXPECT_TRUE(contains(box.horizon->positions, all[i].horizon->positions));
        }
    }
    const auto flat = std::count_if(all.begin(), all.end(), [](const ReceiverBox& r) {
        return r.horizon && std::max({r.horizon->normal.x, r.horizon->normal.y, -r.horizon->normal.z}) == 1.0f;
    });
    EXPECT_GE(with_horizon, static_cast<std::size_t>(flat)) << "those of one face are together";
}

TEST(ReceiverGroups, AreOfNeighbors) {
    Random random(3);
    std::vector<ReceiverBox> all;
    for (int i = 0; i < 4096; ++i)
        all.push_back({box_of(glm::vec3(random.in_box({0, 0, 0}, {8, 8, 0}))), std::nullopt});
    ReceiverGroups groups;
    groups.divide(all, 64);
    EXPECT_EQ(groups.size(), 64u) << "as few as there can be";
    double area = 0.0;
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const glm::dvec3 size = extent(groups.box(g).box);
        area += size.x * size.y;
    }
    EXPECT_LE(area, 64.0) << "they do not overlap";
    EXPECT_GE(area, 40.0);
}

TEST(ReceiverGroups, OutliveWhatTheyWereCopiedFrom) {
    Random random(4);
    const std::vector<ReceiverBox> all = receivers(random, 300);
    ReceiverGroups copy;
    {
        ReceiverGroups groups;
        groups.divide(all, 16);
        copy = groups;
    }
    std::vector<int> seen(all.size(), 0);
    for (std::size_t g = 0; g < copy.size(); ++g) {
        for (const std::uint32_t i : copy.members(g)) ++seen[i];
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), 300);
}

TEST(ReceiverGroups, MayAllLieAtOnePlace) {
    const std::vector<ReceiverBox> all(300, ReceiverBox{box_of(glm::vec3(1.0f)), std::nullopt});
    ReceiverGroups groups;
    groups.divide(all, 7);
    std::size_t count = 0;
    for (std::size_t g = 0; g < groups.size(); ++g) count += groups.members(g).size();
    EXPECT_EQ(count, all.size());
}

}  // namespace
}  // namespace lightcuts::test
