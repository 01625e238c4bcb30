#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <render/io/picture.hpp>
#include <render/surfaces/texture.hpp>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#include <stb_image_write.h>

#include "render/bitmap.hpp"
#include "render/programs.hpp"
#include "render/radiance_encoder.hpp"
#include "render/refusal.hpp"

namespace {

using namespace std::string_literals;
using render::Picture;
using render::srgb_to_linear;
using render::Texture;
using testing::HasSubstr;

Texture read(const std::string& file, bool srgb = true) { return render::texture_of_bytes(file, "a.png", srgb); }

std::string refused(const std::string& file) {
    return refusal([&] { read(file); });
}

std::string big_endian(std::uint32_t number, int bytes) {
    std::string text;
    while (--bytes >= 0) text += static_cast<char>(number >> (8 * bytes));
    return text;
}

std::string png_chunk(const std::string& type, const std::string& data) {
    const std::string checked = type + data;
    std::uint32_t crc = 0xffffffff;
    for (const char c : checked) {
        crc ^= static_cast<std::uint8_t>(c);
        for (int i = 0; i < 8; ++i) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320 : 0);
    }
    return big_endian(static_cast<std::uint32_t>(data.size()), 4) + checked + big_endian(~crc, 4);
}

/// A PNG picture of RGB with 16 bits a channel, in one block that is not compressed.
std::string wide_png(std::uint32_t width, std::uint32_t height, const std::vector<std::uint16_t>& values) {
    std::string rows;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i % (3 * width) == 0) rows += '\0';  // no filter
        rows += big_endian(values[i], 2);
    }
    std::uint32_t a = 1, b = 0;
    for (const char c : rows) {
        a = (a + static_cast<std::uint8_t>(c)) % 65521;
        b = (b + a) % 65521;
    }
    const auto size = static_cast<std::uint32_t>(rows.size());
    const auto little = [](std::uint32_t n) { return std::string{static_cast<char>(n), static_cast<char>(n >> 8)}; };
    return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", big_endian(width, 4) + big_endian(height, 4) + "\x10\x02\0\0\0"s) +
           png_chunk("IDAT", "\x78\x01\x01"s + little(size) + little(~size) + rows + big_endian(b << 16 | a, 4)) +
           png_chunk("IEND", "");
}

void append(void* file, void* data, int size) {
    static_cast<std::string*>(file)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

/// 5 x 4 pixels of RGB, as all programs write them.
struct Files {
    std::vector<std::uint8_t> pixels;
    std::string png, jpeg, tga, flat_tga, bmp;

    Files() {
        for (int i = 0; i < 60; ++i) pixels.push_back(static_cast<std::uint8_t>(4 * i));
        stbi_write_png_to_func(append, &png, 5, 4, 3, pixels.data(), 15);
        stbi_write_jpg_to_func(append, &jpeg, 5, 4, 3, pixels.data(), 100);
        stbi_write_tga_with_rle = 1;
        stbi_write_tga_to_func(append, &tga, 5, 4, 3, pixels.data());
        stbi_write_tga_with_rle = 0;
        stbi_write_tga_to_func(append, &flat_tga, 5, 4, 3, pixels.data());
        stbi_write_bmp_to_func(append, &bmp, 5, 4, 3, pixels.data());
    }
};

TEST(TextureFile, OfBytesIsWhatWasEncoded) {
    const Files files;
    for (const std::string& file : {files.png, files.tga, files.flat_tga, files.bmp}) {
        for (const bool srgb : {false, true}) {
            const Texture texture = read(file, srgb);
            ASSERT_EQ(texture.width, 5);
            ASSERT_EQ(texture.height, 4);
            EXPECT_EQ(texture.name, "a.png");
            for (std::size_t i = 0; i < 60; ++i) {
                const float v = static_cast<float>(files.pixels[i]) / 255.0f;
                EXPECT_EQ(texture.texels[i / 3][static_cast<int>(i % 3)], srgb ? srgb_to_linear(v) : v);
                EXPECT_EQ(texture.texels[i / 3].a, 1.0f);
            }
        }
    }
    const Texture jpeg = read(files.jpeg, false);
    for (std::size_t i = 0; i < 60; ++i) {
        EXPECT_NEAR(jpeg.texels[i / 3].g, static_cast<float>(files.pixels[i / 3 * 3 + 1]) / 255.0f, 0.05f);
    }
}

TEST(TextureFile, Of16BitsKeepsThem) {
    const std::vector<std::uint16_t> values{0, 1, 255, 256, 257, 1000, 32767, 32768, 40000, 65534, 65535, 12345};
    const std::string file = wide_png(2, 2, values);
    for (const bool srgb : {false, true}) {
        const Texture texture = read(file, srgb);
        ASSERT_EQ(texture.texels.size(), 4u);
        for (std::size_t i = 0; i < 12; ++i) {
            const float v = static_cast<float>(values[i]) / 65535.0f;
            EXPECT_EQ(texture.texels[i / 3][static_cast<int>(i % 3)], srgb ? srgb_to_linear(v) : v) << i;
        }
    }
}

TEST(TextureFile, OfRadianceIsLinearAndOfAnyBrightness) {
    const std::string file = radiance_file("EXPOSURE=2\n", "-Y 1 +X 2",
                                           bytes_of({128, 64, 32, 133}) + bytes_of({128, 128, 128, 129}));
    for (const bool srgb : {false, true}) {
        const Texture texture = read(file, srgb);
        ASSERT_EQ(texture.width, 2);
        ASSERT_EQ(texture.height, 1);
        EXPECT_EQ(texture.texels[0], glm::vec4(8, 4, 2, 1));
        EXPECT_EQ(texture.texels[1], glm::vec4(0.5f, 0.5f, 0.5f, 1));
    }
    EXPECT_THAT(refused(file.substr(0, file.size() - 1)), HasSubstr("cut short"));
}

/// An OpenEXR file of three pixels beside each other with alpha.
std::string exr_with(const std::vector<glm::vec4>& texels, bool has_alpha = true) {
    const TemporaryFolder folder;
    Picture picture(static_cast<int>(texels.size()), 1);
    if (has_alpha) picture.add_channel("A");
    for (std::size_t i = 0; i < texels.size(); ++i) {
        picture.pixels[i] = glm::vec3(texels[i]);
        if (has_alpha) picture.channels[0].values[i] = texels[i].a;
    }
    write_exr(folder / "a.exr", picture);
    return folder.read("a.exr");
}

TEST(TextureFile, OfOpenExrIsLinearAndNoLongerPremultiplied) {
    for (const bool srgb : {false, true}) {
        const Texture texture = read(exr_with({{8, 4, 2, 1}, {1, 0.5, 0.25, 0.5}, {3, 2, 1, 0}, {1, 1, 1, 1.5}}), srgb);
        EXPECT_EQ(texture.texels[0], glm::vec4(8, 4, 2, 1));
        EXPECT_EQ(texture.texels[1], glm::vec4(2, 1, 0.5f, 0.5f));
        EXPECT_EQ(texture.texels[2], glm::vec4(3, 2, 1, 0));  // what shines without covering anything
        EXPECT_EQ(texture.texels[3], glm::vec4(1, 1, 1, 1));
        EXPECT_EQ(read(exr_with({{8, 4, 2, 0}}, false), srgb).texels[0], glm::vec4(8, 4, 2, 1));
    }
}

TEST(TextureFile, OfOpenExrMayStayPremultiplied) {
    const std::string file = exr_with({{8, 4, 2, 1}, {1, 0.5, 0.25, 0.5}, {3, 2, 1, 0}});
    const Texture texture = render::texture_of_bytes(file, "a.exr", true, render::Premultiplication::keep);
    EXPECT_EQ(texture.texels[0], glm::vec4(8, 4, 2, 1));
    EXPECT_EQ(texture.texels[1], glm::vec4(1, 0.5f, 0.25f, 0.5f));
    EXPECT_EQ(texture.texels[2], glm::vec4(3, 2, 1, 0));
}

TEST(TextureFile, RefusesTexelsThatAreNoLight) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
    for (const glm::vec4& texel : {glm::vec4(-1, 0, 0, 1), glm::vec4(0, nan, 0, 1), glm::vec4(0, 0, infinite, 1),
                                   glm::vec4(0, 0, 0, nan), glm::vec4(0, 0, 0, -1)}) {
        EXPECT_THAT(refused(exr_with({glm::vec4(1), glm::vec4(1), texel, glm::vec4(-1)})),
                    HasSubstr("a.png: pixel (2, 0) is negative or not finite"));
    }
}

TEST(TextureFile, OfAnotherKindIsNamed) {
    struct Kind {
        std::string bytes;
        const char* name;
    };
    for (const Kind& kind : {Kind{"RIFF\x10\0\0\0WEBPVP8 "s, "is a WebP picture, which cannot be read"},
                             {"\xabKTX 20\xbb\r\n\x1a\n", "KTX2"},
                             {"DDS \x7c\0\0\0"s, "DDS"},
                             {"\0\0\0\x20"
                              "ftypavif\0\0\0\0"s,
                              "AVIF"},
                             {"\0\0\0\x18"
                              "ftypheic\0\0\0\0"s,
                              "HEIF"},
                             {"II*\0\x08\0\0\0"s, "TIFF"},
                             {"\0\0\0\x0cJXL \r\n\x87\n"s, "JPEG XL"},
                             {"\xff\x0a\x12", "JPEG XL"},
                             {"\0\0\0\x0cjP  \r\n\x87\n"s, "JPEG 2000"},
                             {"qoif\0\0\0\x01"s, "QOI"},
                             {"<svg xmlns='http://www.w3.org/2000/svg'/>", "SVG"},
                             {"<html>", "web page"}}) {
        const std::string message = refused(kind.bytes + std::string(64, '\x01'));
        EXPECT_THAT(message, HasSubstr(kind.name));
        EXPECT_THAT(message, HasSubstr("convert it to PNG"));
    }
    EXPECT_THAT(refused(""), HasSubstr("empty"));
    EXPECT_THAT(refused("no picture at all, but text that is long enough for a header"), HasSubstr("not an image"));
}

TEST(TextureFile, CutShortAnywhereIsRefused) {
    const Files files;
    std::string tall;
    stbi_write_tga_with_rle = 0;
    stbi_write_tga_to_func(append, &tall, 5, 30, 3, std::vector<std::uint8_t>(5 * 30 * 3, 7).data());
    for (const std::string& file :
         {files.png, files.jpeg, files.tga, files.flat_tga, tall, wide_png(2, 1, {1, 2, 3, 4, 5, 6}),
          bitmap({{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {10, 11, 12}})}) {
        read(file);
        for (std::size_t size = 0; size < file.size(); ++size) {
            // The last bytes of a PNG picture are a checksum that the reader ignores.
            const bool is_png = file.starts_with("\x89PNG");
            if (is_png && size >= file.size() - 4) continue;
            EXPECT_THAT(refused(file.substr(0, size)), HasSubstr("a.png: not an image")) << size << file.substr(0, 4);
        }
    }
}

TEST(TextureFile, TooLargeIsRefusedBeforeItIsDecoded) {
    const std::string file = wide_png(1, 1, {1, 2, 3});
    const auto sized = [&](std::uint32_t width, std::uint32_t height) {
        return file.substr(0, 8) + png_chunk("IHDR", big_endian(width, 4) + big_endian(height, 4) + "\x10\x02\0\0\0"s) +
               file.substr(8 + 25);
    };
    EXPECT_THAT(refused(sized(100'000, 100'000)), HasSubstr("too large"));
    EXPECT_THAT(refused(sized(150'000, 1)), HasSubstr("150000 x 1 pixels are more than"));
}

TEST(TextureFile, SurvivesDamage) {
    const Files files;
    std::mt19937 random(1);
    for (int i = 0; i < 2000; ++i) {
        for (std::string file : {files.png, files.jpeg, files.tga, files.bmp, wide_png(2, 1, {1, 2, 3, 4, 5, 6})}) {
            for (auto n = 1 + random() % 3; n > 0; --n) file[random() % file.size()] = static_cast<char>(random());
            // Sizes stay small, for the test's sake.
            for (const std::size_t high : {16u, 17u, 20u, 21u}) {
                if (file.starts_with("\x89PNG")) file[high] = '\0';
            }
            try {
                read(file);
            } catch (const lightcuts::invalid_input& problem) {
                EXPECT_EQ(std::string(problem.what()).find('\n'), std::string::npos);
            }
        }
    }
}

class TexturedScene : public Programs {
protected:
    /// The radiance of a square that shines with a texture, seen from the front.
    glm::vec3 seen(const std::string& map) {
        folder.write("lamp.mtl", "newmtl lamp\nKd 0 0 0\nKe 1 1 1\nmap_Ke " + map + "\n");
        folder.write("lamp.obj",
                     "mtllib lamp.mtl\nv -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                     "usemtl lamp\nf 1/1 2/2 3/3 4/4\n");
        const auto result = render("lamp.obj --quiet --size 4x4 --eye 0,9,0 --target 0,0,0 --up 0,0,-1 --fov 2");
        EXPECT_EQ(result.status, 0) << result.err;
        return render::read_exr(folder / "render.exr").pixels[5];
    }
};

TEST_F(TexturedScene, ShinesAsBrightlyAsItsTextureSays) {
    const auto radiance = [](std::uint8_t exponent) {
        return radiance_file("", "-Y 2 +X 4", flat(Scanline(8, Rgbe{128, 128, 128, exponent})));
    };
    folder.write("eight.hdr", radiance(132));
    folder.write("half.hdr", radiance(128));
    folder.write("eight.exr", exr_with({{8, 8, 8, 1}, {8, 8, 8, 1}}, false));
    EXPECT_EQ(seen("eight.hdr"), glm::vec3(8.0f));
    EXPECT_EQ(seen("half.hdr"), glm::vec3(0.5f));
    EXPECT_EQ(seen("eight.exr"), glm::vec3(8.0f));
}

}  // namespace
