#include <chrono>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <render/io/left_out.hpp>

#include "render/bitmap.hpp"
#include "render/gltf_builder.hpp"

namespace {

using render::LeftOut;
using render::LeftOutList;

TEST(LeftOutList, HasEachThingOnceInTheOrderOfTheFirst) {
    LeftOutList all;
    leave_out(all, "b", "not supported");
    leave_out(all, "a", "not supported");
    leave_out(all, "b", "not supported");
    leave_out(all, "b", "unknown");
    EXPECT_THAT(all, testing::ElementsAre(LeftOut{"b", "not supported"}, LeftOut{"a", "not supported"},
                                          LeftOut{"b", "unknown"}));
}

TEST(LeftOutList, CountsWhatFollowsTheFirstOfAReason) {
    LeftOutList all;
    const std::size_t many = LeftOutList::most_named + 30;
    for (int round = 0; round < 2; ++round) {
        for (std::size_t i = 0; i < many; ++i) leave_out(all, "thing " + std::to_string(i), "it is one of many");
    }
    leave_out(all, "another", "it is alone");
    ASSERT_EQ(all.size(), LeftOutList::most_named + 1);
    const std::string last = "thing " + std::to_string(LeftOutList::most_named - 1);
    EXPECT_EQ(all[LeftOutList::most_named - 1].what, last + ", and 30 more");
    EXPECT_EQ(all[0].what, "thing 0");
    EXPECT_EQ(all[LeftOutList::most_named].what, "another");
}

TEST(LeftOutList, TakesNoLongerTheMoreIsThere) {
    LeftOutList all;
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < 500'000; ++i) leave_out(all, "thing " + std::to_string(i), "it is one of many");
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    EXPECT_LT(seconds.count(), 20.0) << "a search of the list for each takes minutes";
    EXPECT_EQ(all.size(), LeftOutList::most_named);
}

TEST(LeftOutList, OfManyPrimitivesWithoutUvsIsShort) {
    GltfBuilder file;
    file.append("images", {{"bufferView", file.add_bytes(bitmap({{255, 0, 0}}))}});
    file.append("textures", {{"source", 0}});
    const std::size_t material = file.add_material(GltfBuilder::Json::object(), {{"baseColorTexture", {{"index", 0}}}});
    const GltfBuilder::Json attributes = file.square();
    for (int i = 0; i < 100; ++i) file.add_node({{"mesh", file.add_mesh(attributes, {{"material", material}})}});
    const render::Scene scene = file.load();
    ASSERT_EQ(scene.left_out.size(), LeftOutList::most_named);
    EXPECT_THAT(scene.left_out[LeftOutList::most_named - 1].what,
                testing::EndsWith(", and " + std::to_string(100 - LeftOutList::most_named) + " more"));
}

}  // namespace
