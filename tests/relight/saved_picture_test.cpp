#include <memory>

#include <gtest/gtest.h>
#include <lightcuts/core/invalid_input.hpp>
#include <relight/saved_picture.hpp>

#include "small_world.hpp"

namespace {

relight::ShownFrame shown(const render::Picture& picture) {
    relight::ShownFrame frame;
    frame.picture = std::make_shared<const render::Picture>(picture);
    frame.bytes = render::srgb_bytes(render::tone_mapped(picture));
    return frame;
}

TEST(SavedPicture, TakesTheFirstNumberThatIsFree) {
    const TemporaryFolder folder;
    const render::Picture picture = small_map();
    EXPECT_EQ(relight::save_picture(folder / "p.exr", shown(picture)), folder / "p-0000.exr");
    EXPECT_EQ(render::read_exr(folder / "p-0000.exr").pixels, picture.pixels);
    render::write_png(folder / "expected.png", picture.width, picture.height, render::tone_mapped(picture));
    EXPECT_EQ(folder.read("p-0000.png"), folder.read("expected.png"));
    folder.write("p-0001.png", "somebody else's");
    EXPECT_EQ(relight::save_picture(folder / "p.exr", shown(picture)), folder / "p-0002.exr");
    EXPECT_EQ(folder.read("p-0001.png"), "somebody else's");
    EXPECT_FALSE(folder.has("p-0001.exr"));
}

TEST(SavedPicture, LeavesNothingWhereItCannotWrite) {
    const TemporaryFolder folder;
    EXPECT_THROW(relight::save_picture(folder / "none/p.exr", shown(small_map())), lightcuts::invalid_input);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
