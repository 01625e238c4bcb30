#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <render/io/map_picture.hpp>
#include <render/io/picture.hpp>

#include "render/radiance_encoder.hpp"
#include "render/refusal.hpp"
#include "support/temporary_folder.hpp"

namespace {

using namespace std::string_literals;
using render::Picture;
using testing::HasSubstr;

TEST(MapPicture, IsReadByWhatTheFileHolds) {
    const TemporaryFolder folder;
    const std::string radiance = radiance_file("", "-Y 1 +X 2", flat(Scanline(2, Rgbe{128, 64, 32, 129})));
    Picture picture(2, 1);
    picture.pixels = {{1.0f, 0.5f, 0.25f}, {1.0f, 0.5f, 0.25f}};
    picture.add_channel("depth");
    write_exr(folder / "written.exr", picture);
    const std::string openexr = folder.read("written.exr");
    for (const char* name : {"a.hdr", "a.exr", "a.HDR", "a.pic", "a.png", "a"}) {
        for (const std::string& file : {radiance, openexr}) {
            const Picture read = render::read_map(folder.write(name, file));
            EXPECT_EQ(read.pixels, picture.pixels) << name;
            EXPECT_TRUE(read.channels.empty());
        }
    }
}

TEST(MapPicture, IsRefusedByWhatItIs) {
    const TemporaryFolder folder;
    const auto refused = [&](const std::string& name) {
        const std::string message = refusal([&] { render::read_map(folder / name); });
        EXPECT_THAT(message, HasSubstr(folder / name));
        return message;
    };
    EXPECT_THAT(refused("absent.hdr"), HasSubstr("no such file"));
    EXPECT_THAT(refused("."), HasSubstr("cannot be read"));
    EXPECT_THAT(refusal([] { render::read_map("/dev/zero"); }), HasSubstr("/dev/zero"));
    const auto refused_bytes = [&](const std::string& bytes) {
        folder.write("a.hdr", bytes);
        return refused("a.hdr");
    };
    struct Kind {
        std::string bytes;
        const char* name;
    };
    for (const Kind& kind : {Kind{"", "empty"},
                             {"text", "neither OpenEXR nor Radiance"},
                             {"\x89PNG\r\n\x1a\n", "PNG"},
                             {"\xff\xd8\xff\xe0", "JPEG"},
                             {"RIFF\x10\0\0\0WEBP"s, "WebP"},
                             {"II*\0"s, "TIFF"},
                             {"MM\0*"s, "TIFF"},
                             {"<!DOCTYPE html>", "web page"},
                             {"PK\x03\x04", "ZIP"},
                             {"PF\n2 1\n", "PFM"},
                             {"version https://git-lfs.github.com/spec/v1\n", "Git LFS"}}) {
        EXPECT_THAT(refused_bytes(kind.bytes), HasSubstr(kind.name));
    }
    // Damage is named by the file's own kind.
    EXPECT_THAT(refused_bytes("#?RADIANCE\n"), HasSubstr("Radiance picture that can be read (it is cut short"));
    EXPECT_THAT(refused_bytes("\x76\x2f\x31\x01\x02"), HasSubstr("OpenEXR picture (it is cut short"));
}

}  // namespace
