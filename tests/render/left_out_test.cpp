#include <chrono>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <render/io/left_out.hpp>

#include "bitmap.hpp"
#include "gltf_builder.hpp"

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

/// A glTF file of `count` meshes whose material has a texture and whose vertices have no uvs.
double seconds_to_load_without_uvs(int count, std::size_t* named) {
    GltfBuilder file;
    file.append("images", {{"bufferView", file.add_bytes(bitmap({{255, 0, 0}}))}});
    file.append("textures", {{"source", 0}});
    const std::size_t material = file.add_material({}, {{"baseColorTexture", {{"index", 0}}}});
    const GltfBuilder::Json attributes = file.square();
    for (int i = 0; i < count; ++i) { file.add_node({{"mesh", file.add_mesh(attributes, {{"material", material}})}}); }
    const auto begin = std::chrono::steady_clock::now();
    *named = file.load().left_out.size();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

TEST(LeftOutList, ManyPrimitivesWithoutUvsAreFewLinesInLinearTime) {
    std::size_t few = 0, many = 0;
    const double short_time = seconds_to_load_without_uvs(1000, &few);
    const double long_time = seconds_to_load_without_uvs(16000, &many);
    EXPECT_EQ(few, LeftOutList::most_named);
    EXPECT_EQ(many, LeftOutList::most_named);
    EXPECT_LT(long_time, 16.0 * 5.0 * short_time) << "quadratic: 256 times as long";
}

}  // namespace
