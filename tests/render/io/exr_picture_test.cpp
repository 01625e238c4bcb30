#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>
#include <ImfTiledOutputFile.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <lightcuts/core/invalid_input.hpp>
#include <render/io/exr_picture.hpp>
#include <render/io/picture.hpp>

#include "render/refusal.hpp"
#include "support/temporary_folder.hpp"

namespace {

using Imath::Box2i;
using render::ExrUse;
using render::Picture;
using testing::HasSubstr;

Picture read(const std::string& file, ExrUse use = ExrUse::picture) { return exr_picture(file, "a.exr", use); }

std::string refused(const std::string& file, ExrUse use = ExrUse::picture) {
    return refusal([&] { read(file, use); });
}

/// The value of channel `c` at a pixel: different for each, and one that a half holds.
float value_at(int x, int y, std::size_t c) {
    return static_cast<float>(1 + ((x + 50) * 7 + (y + 50) * 31 + static_cast<int>(c) * 57) % 1000) / 8.0f;
}

/// A plane for each channel of a file.
class Planes {
public:
    Planes(const Box2i& window, const std::vector<std::string>& names) : window_(window), names_(names) {
        for (std::size_t c = 0; c < names.size(); ++c) {
            std::vector<float>& plane = planes_.emplace_back();
            for (int y = window.min.y; y <= window.max.y; ++y) {
                for (int x = window.min.x; x <= window.max.x; ++x) plane.push_back(value_at(x, y, c));
            }
        }
    }
    void declare(Imf::Header& header, Imf::PixelType type) const {
        for (const std::string& name : names_) header.channels().insert(name, Imf::Channel(type));
    }
    /// The values as numbers of a type.
    Imf::FrameBuffer buffer(Imf::PixelType type) {
        Imf::FrameBuffer buffer;
        for (std::size_t c = 0; c < names_.size(); ++c) {
            const std::vector<float>& plane = planes_[c];
            if (type == Imf::FLOAT) buffer.insert(names_[c], Imf::Slice::Make(type, plane.data(), window_));
            if (type == Imf::HALF) {
                halves_.emplace_back(plane.begin(), plane.end());
                buffer.insert(names_[c], Imf::Slice::Make(type, halves_.back().data(), window_));
            }
            if (type == Imf::UINT) {
                auto& numbers = integers_.emplace_back();
                for (const float v : plane) numbers.push_back(static_cast<unsigned>(v));
                buffer.insert(names_[c], Imf::Slice::Make(type, numbers.data(), window_));
            }
        }
        return buffer;
    }
    float& at(std::size_t channel, std::size_t pixel) { return planes_[channel][pixel]; }

private:
    Box2i window_;
    std::vector<std::string> names_;
    std::vector<std::vector<float>> planes_;
    std::vector<std::vector<half>> halves_;
    std::vector<std::vector<unsigned>> integers_;
};

Box2i window(int x0, int y0, int x1, int y1) { return {{x0, y0}, {x1, y1}}; }

const std::vector<std::string> rgb{"R", "G", "B"};

/// Files that OpenEXR wrote.
class ExrPicture : public ::testing::Test {
protected:
    TemporaryFolder folder;

    /// A file in scanlines, of `value_at` in each channel.
    std::string written(Imf::Header header, const std::vector<std::string>& names = rgb,
                        Imf::PixelType type = Imf::FLOAT) {
        Planes planes(header.dataWindow(), names);
        planes.declare(header, type);
        return written(header, planes.buffer(type));
    }
    std::string written(const Imf::Header& header, const Imf::FrameBuffer& buffer) {
        {
            Imf::OutputFile file((folder / "a.exr").c_str(), header);
            file.setFrameBuffer(buffer);
            file.writePixels(header.dataWindow().max.y - header.dataWindow().min.y + 1);
        }
        return folder.read("a.exr");
    }
    std::string tiled(Imf::Header header, Imf::LevelMode mode) {
        Planes planes(header.dataWindow(), rgb);
        planes.declare(header, Imf::FLOAT);
        header.setTileDescription(Imf::TileDescription(7, 5, mode));
        {
            Imf::TiledOutputFile file((folder / "a.exr").c_str(), header);
            file.setFrameBuffer(planes.buffer(Imf::FLOAT));
            for (int level = 0; level < file.numLevels(); ++level) {
                file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
            }
        }
        return folder.read("a.exr");
    }
    /// Luminance and chroma of a picture that changes slowly; a saturated color in its left half.
    std::string luminance_chroma(const Box2i& display, const Box2i& data, std::vector<glm::vec3>* colors = nullptr) {
        Imf::Header header(display, data);
        const int width = data.max.x - data.min.x + 1, height = data.max.y - data.min.y + 1;
        std::vector<Imf::Rgba> pixels;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const float v = 1.0f + 0.01f * static_cast<float>(x + y);
                const glm::vec3 color = x < width / 2 ? glm::vec3(3.0f, 0.5f, 0.25f) * v : glm::vec3(0.25f, 1.0f, 2.0f);
                pixels.emplace_back(color.r, color.g, color.b, 1.0f);
                if (colors) colors->push_back(color);
            }
        }
        {
            Imf::RgbaOutputFile file((folder / "yc.exr").c_str(), header, Imf::WRITE_YC);
            file.setFrameBuffer(pixels.data() - data.min.x - std::ptrdiff_t(data.min.y) * width, 1,
                                static_cast<std::size_t>(width));
            file.writePixels(height);
        }
        return folder.read("yc.exr");
    }
    /// A part without color, and one with it.
    std::string multi_part(const char* second_type = "R") {
        std::vector<Imf::Header> headers(2, Imf::Header(window(0, 0, 5, 4), window(0, 0, 5, 4)));
        std::vector<Planes> planes{{window(0, 0, 5, 4), {"Z"}}, {window(0, 0, 5, 4), {second_type, "G", "B"}}};
        for (std::size_t i = 0; i < 2; ++i) {
            headers[i].setName(i == 0 ? "depth" : "beauty");
            headers[i].setType(Imf::SCANLINEIMAGE);
            planes[i].declare(headers[i], Imf::FLOAT);
        }
        {
            Imf::MultiPartOutputFile file((folder / "parts.exr").c_str(), headers.data(), 2);
            for (int i = 0; i < 2; ++i) {
                Imf::OutputPart part(file, i);
                part.setFrameBuffer(planes[static_cast<std::size_t>(i)].buffer(Imf::FLOAT));
                part.writePixels(5);
            }
        }
        return folder.read("parts.exr");
    }
    std::string deep() {
        Imf::Header header(4, 2);
        for (const std::string& name : rgb) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        header.setType(Imf::DEEPSCANLINE);
        header.compression() = Imf::ZIPS_COMPRESSION;
        std::vector<unsigned> counts(8, 1);
        std::vector<float> samples(8, 1.0f);
        std::vector<float*> pointers;
        for (float& sample : samples) pointers.push_back(&sample);
        Imf::DeepFrameBuffer buffer;
        buffer.insertSampleCountSlice(Imf::Slice::Make(Imf::UINT, counts.data(), header.dataWindow()));
        for (const std::string& name : rgb) {
            buffer.insert(name, Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(pointers.data()), sizeof(float*),
                                               4 * sizeof(float*), sizeof(float)));
        }
        {
            Imf::DeepScanLineOutputFile file((folder / "deep.exr").c_str(), header);
            file.setFrameBuffer(buffer);
            file.writePixels(2);
        }
        return folder.read("deep.exr");
    }
};

/// Expects `value_at` inside `data`, black elsewhere, over the display window.
void expect_windows(const Picture& picture, const Box2i& display, const Box2i& data, const std::string& what) {
    ASSERT_EQ(picture.width, display.max.x - display.min.x + 1) << what;
    ASSERT_EQ(picture.height, display.max.y - display.min.y + 1) << what;
    const Picture::Channel* depth = picture.find("Z");
    std::size_t i = 0;
    for (int y = display.min.y; y <= display.max.y; ++y) {
        for (int x = display.min.x; x <= display.max.x; ++x, ++i) {
            const auto value = [&](std::size_t c) { return data.intersects(Imath::V2i(x, y)) ? value_at(x, y, c) : 0; };
            ASSERT_EQ(picture.pixels[i], glm::vec3(value(0), value(1), value(2))) << what << ' ' << x << ',' << y;
            if (depth) { ASSERT_EQ(depth->values[i], value(3)) << what << ' ' << x << ',' << y; }
        }
    }
}

TEST_F(ExrPicture, IsWhatTheDisplayWindowShows) {
    const Box2i display = window(0, 0, 20, 10);
    const Box2i shifted = window(-30, 12, -9, 22);
    for (const Box2i& of : {display, shifted}) {
        const auto moved = [&](int x0, int y0, int x1, int y1) {
            return window(x0 + of.min.x, y0 + of.min.y, x1 + of.min.x, y1 + of.min.y);
        };
        for (const Box2i& data : {of, moved(3, 2, 15, 8), moved(-4, -3, 25, 13), moved(-4, 2, 6, 30),
                                  moved(15, -9, 40, 3), moved(7, 4, 7, 4), moved(20, 10, 30, 12)}) {
            Imf::Header header(of, data);
            header.compression() = Imf::ZIP_COMPRESSION;
            const std::string file = written(header, {"R", "G", "B", "Z"});
            const std::string what = std::to_string(data.min.x) + "," + std::to_string(data.min.y);
            expect_windows(read(file), of, data, what);
            ASSERT_NE(read(file).find("Z"), nullptr);
        }
    }
}

TEST_F(ExrPicture, MayHaveBlackRows) {
    // Rows from the last to the first, and pixels of another shape than squares.
    Imf::Header header(window(0, 0, 9, 9), window(2, 3, 9, 9), 2.0f);
    header.lineOrder() = Imf::DECREASING_Y;
    expect_windows(read(written(header)), window(0, 0, 9, 9), window(2, 3, 9, 9), "decreasing");
}

TEST_F(ExrPicture, HoldsAnyTypeOfNumbers) {
    const Box2i all = window(0, 0, 12, 6);
    expect_windows(read(written(Imf::Header(all, all), rgb, Imf::HALF)), all, all, "half");
    const Picture integers = read(written(Imf::Header(all, all), rgb, Imf::UINT));
    for (int x = 0; x < 13; ++x) {
        EXPECT_EQ(integers.pixels[static_cast<std::size_t>(x)].g, std::floor(value_at(x, 0, 1))) << x;
    }
}

TEST_F(ExrPicture, IsReadFromTilesAndTheirFirstLevel) {
    const Box2i display = window(0, 0, 29, 17), data = window(3, 2, 28, 20);
    for (const Imf::LevelMode mode : {Imf::ONE_LEVEL, Imf::MIPMAP_LEVELS}) {
        expect_windows(read(tiled(Imf::Header(display, data), mode)), display, data, "tiled");
    }
}

TEST_F(ExrPicture, MayBeCompressedInAnyWayThatLosesNothing) {
    const Box2i all = window(0, 0, 40, 40);
    for (const Imf::Compression compression : {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION,
                                               Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
        Imf::Header header(all, all);
        header.compression() = compression;
        expect_windows(read(written(header)), all, all, std::to_string(compression));
    }
}

TEST_F(ExrPicture, OfLuminanceAndChromaIsColored) {
    const Box2i display = window(0, 0, 95, 31);
    std::vector<glm::vec3> colors;
    for (const Box2i& data : {display, window(-2, 4, 69, 35)}) {
        colors.clear();
        const Picture picture = read(luminance_chroma(display, data, &colors));
        ASSERT_EQ(picture.width, 96);
        ASSERT_EQ(picture.height, 32);
        EXPECT_TRUE(picture.channels.empty());
        const int width = data.max.x - data.min.x + 1;
        for (int y = 0; y < 32; ++y) {
            for (int x = 0; x < 96; ++x) {
                const glm::vec3 read_color = picture.pixels[static_cast<std::size_t>(96 * y + x)];
                const int column = x - data.min.x;
                if (!data.intersects(Imath::V2i(x, y))) {
                    EXPECT_EQ(read_color, glm::vec3(0.0f));
                } else if (std::abs(column - width / 2) > 26) {  // beyond what filters mix of both
                    const glm::vec3 color = colors[static_cast<std::size_t>(width * (y - data.min.y) + column)];
                    for (int c = 0; c < 3; ++c) EXPECT_NEAR(read_color[c] / color[c], 1.0f, 0.04f) << x << ' ' << y;
                }
            }
        }
    }
}

TEST_F(ExrPicture, OfLuminanceAloneIsGray) {
    const Picture picture = read(written(Imf::Header(5, 3), {"Y", "A"}));
    EXPECT_EQ(picture.pixels[7], glm::vec3(value_at(2, 1, 0)));
    EXPECT_NE(picture.find("A"), nullptr);
    EXPECT_EQ(picture.find("Y"), nullptr);
}

TEST_F(ExrPicture, IsReadForItsUse) {
    const std::string file = written(Imf::Header(4, 2), {"R", "G", "B", "A", "Z", "normal.X"});
    EXPECT_EQ(read(file).channels.size(), 3u);
    EXPECT_TRUE(read(file, ExrUse::map).channels.empty());
    const Picture texture = read(file, ExrUse::texture);
    ASSERT_EQ(texture.channels.size(), 1u);
    EXPECT_EQ(texture.channels[0].name, "A");
    EXPECT_EQ(texture.channels[0].values[5], value_at(1, 1, 3));
    EXPECT_EQ(texture.pixels[5], read(file).pixels[5]);
}

TEST_F(ExrPicture, OfACubeIsNoMap) {
    Imf::Header header(4, 24);
    Imf::addEnvmap(header, Imf::ENVMAP_CUBE);
    const std::string file = written(header);
    EXPECT_EQ(read(file).size(), 96u);
    EXPECT_THAT(refused(file, ExrUse::map), HasSubstr("cube map"));
    Imf::addEnvmap(header, Imf::ENVMAP_LATLONG);
    EXPECT_EQ(read(written(header), ExrUse::map).size(), 96u);
}

TEST_F(ExrPicture, IsThePartThatHasColor) {
    expect_windows(read(multi_part()), window(0, 0, 5, 4), window(0, 0, 5, 4), "second part");
    EXPECT_THAT(refused(multi_part("X")), HasSubstr("it has no R, G and B, nor Y, but Z, B, G, X;"));
    EXPECT_THAT(refused(deep()), HasSubstr("deep"));
}

TEST_F(ExrPicture, SaysWhichLayersThereAre) {
    EXPECT_THAT(refused(written(Imf::Header(3, 2), {"beauty.R", "beauty.G", "beauty.B", "R"})),
                HasSubstr("it has no R, G and B, nor Y, but R, beauty.B, beauty.G, beauty.R;"));
    std::vector<std::string> many;
    for (int i = 0; i < 100; ++i) many.push_back("layer" + std::to_string(i) + ".R");
    const std::string message = refused(written(Imf::Header(3, 2), many));
    EXPECT_THAT(message, HasSubstr("and 88 more"));
    EXPECT_LT(message.size(), 400u);
}

TEST_F(ExrPicture, IsRefusedWithFewerSamplesThanPixels) {
    const std::vector<float> values(8, 1.0f);
    const auto sampled = [&](const std::vector<std::string>& full, const std::vector<std::string>& fewer) {
        Imf::Header header(4, 2);
        Imf::FrameBuffer buffer;
        const auto add = [&](const std::string& name, int every) {
            header.channels().insert(name, Imf::Channel(Imf::FLOAT, every, every));
            buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, values.data(), header.dataWindow(), 0, 0, every, every));
        };
        for (const std::string& name : full) add(name, 1);
        for (const std::string& name : fewer) add(name, 2);
        return written(header, buffer);
    };
    EXPECT_THAT(refused(sampled({"R", "G"}, {"B"})), HasSubstr("channel B is sampled at every 2 x 2 pixels"));
    EXPECT_THAT(refused(sampled({}, {"Y"})), HasSubstr("channel Y is sampled at every 2 x 2 pixels"));
    EXPECT_THAT(refused(sampled({"Y", "RY", "BY"}, {})), HasSubstr("channel RY is sampled at every 1 x 1 pixels"));
    EXPECT_THAT(refused(sampled({"Y"}, {"RY"})), HasSubstr("no channel BY"));
    // Others than color do not matter.
    EXPECT_TRUE(read(sampled({"R", "G", "B"}, {"Z"})).channels.empty());
}

TEST_F(ExrPicture, KeepsWhatIsNoNumber) {
    Imf::Header header(2, 1);
    Planes planes(header.dataWindow(), rgb);
    planes.declare(header, Imf::FLOAT);
    planes.at(0, 0) = std::numeric_limits<float>::quiet_NaN();
    planes.at(1, 1) = -std::numeric_limits<float>::infinity();
    planes.at(2, 1) = -3.0f;
    const Picture picture = read(written(header, planes.buffer(Imf::FLOAT)));
    EXPECT_TRUE(std::isnan(picture.pixels[0].r));
    EXPECT_EQ(picture.pixels[1].g, -std::numeric_limits<float>::infinity());
    EXPECT_EQ(picture.pixels[1].b, -3.0f);
}

TEST_F(ExrPicture, OfOtherPrimariesBecomesRec709) {
    const std::vector<glm::vec3> colors{{1.0f, 1.0f, 1.0f}, {1.0f, 0.7f, 0.5f}, {0.6f, 1.0f, 0.7f}, {0.5f, 0.6f, 1.0f}};
    const auto of = [&](const Imf::Chromaticities& chromaticities) {
        Imf::Header header(4, 1);
        Imf::addChromaticities(header, chromaticities);
        Planes planes(header.dataWindow(), rgb);
        planes.declare(header, Imf::FLOAT);
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t c = 0; c < 3; ++c) planes.at(c, i) = colors[i][static_cast<int>(c)];
        }
        return written(header, planes.buffer(Imf::FLOAT));
    };
    EXPECT_EQ(read(of({})).pixels, colors);
    // ACEScg, by the matrix to Rec. 709 with Bradford's adaptation from its white, as published to four digits.
    const Picture picture = read(of({{0.713f, 0.293f}, {0.165f, 0.830f}, {0.128f, 0.044f}, {0.32168f, 0.33767f}}));
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::vec3 v = colors[i];
        const glm::vec3 expected(1.7051f * v.r - 0.6218f * v.g - 0.0833f * v.b,
                                 -0.1303f * v.r + 1.1408f * v.g - 0.0105f * v.b,
                                 -0.0240f * v.r - 0.1290f * v.g + 1.1530f * v.b);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(picture.pixels[i][c], expected[c], 3e-4f) << i;
    }
    EXPECT_THAT(refused(of({{0.3f, 0.3f}, {0.3f, 0.3f}, {0.3f, 0.3f}, {0.3f, 0.3f}})), HasSubstr("primaries"));
}

/// The same file with a 32-bit number in place of the one that stands after `before`.
std::string with_number(std::string file, const std::string& before, std::size_t after, std::uint32_t number) {
    const std::size_t at = file.find(before);
    EXPECT_NE(at, std::string::npos) << before;
    for (std::size_t i = 0; i < 4; ++i) file[at + before.size() + after + i] = static_cast<char>(number >> (8 * i));
    return file;
}

TEST_F(ExrPicture, IsRefusedWithItsTrueCause) {
    EXPECT_THAT(refused(""), HasSubstr("empty"));
    EXPECT_THAT(refused("text"), HasSubstr("does not begin like one"));
    EXPECT_THAT(refused("#?RADIANCE\n"), HasSubstr("Radiance"));
    const std::string file = written(Imf::Header(8, 4));
    const std::string data("dataWindow\0box2i\0", 17), display("displayWindow\0box2i\0", 20);
    // Sizes: after the attribute's own come min.x, min.y, max.x and max.y.
    for (const std::string& of : {data, display}) {
        EXPECT_THAT(refused(with_number(file, of, 4 + 8, 200'000)), HasSubstr("200001 x 4 pixels are more than"));
    }
    EXPECT_THAT(refused(with_number(with_number(file, display, 4 + 8, 99'999), display, 4 + 12, 99'999)),
                HasSubstr("100000 x 100000 pixels are more than"));
    EXPECT_THAT(refused(with_number(file, data, 4 + 12, 1000)), HasSubstr("cut short or damaged"));
    // OpenEXR's own words, without the name that stands before them already.
    const std::string compression("compression\0compression\0", 24);
    std::string unknown = file;
    unknown[file.find(compression) + compression.size() + 4] = 99;
    EXPECT_EQ(refused(unknown),
              "a.exr: cannot be read as an OpenEXR picture (Unknown compression type in image header.)");
    // An attribute that is longer than the file must not be made room for.
    EXPECT_THAT(refused(with_number(file, data, 0, 0x7fffffff)), HasSubstr("'dataWindow' is longer than the file"));
    EXPECT_THAT(refused(with_number(file, std::string("channels\0chlist\0", 16), 0, 0xffffffff)),
                HasSubstr("'channels' is longer than the file"));
}

TEST_F(ExrPicture, LimitsItsValues) {
    std::vector<std::string> names = rgb;
    for (int i = 0; i < 100; ++i) names.push_back("layer" + std::to_string(i));
    const std::string display("displayWindow\0box2i\0", 20);
    const std::string file = with_number(with_number(written(Imf::Header(2, 2), names), display, 4 + 8, 4095), display,
                                         4 + 12, 4095);
    EXPECT_THAT(refused(file), HasSubstr("103 channels of 4096 x 4096 pixels are more than"));
}

TEST_F(ExrPicture, CutShortAnywhereIsRefused) {
    Imf::Header header(window(0, 0, 7, 17), window(1, 1, 7, 17));
    header.compression() = Imf::NO_COMPRESSION;
    std::vector<std::string> files{written(header)};
    header.compression() = Imf::PIZ_COMPRESSION;
    files.push_back(written(header));
    header.compression() = Imf::ZIP_COMPRESSION;
    files.push_back(written(header));
    files.push_back(tiled(header, Imf::ONE_LEVEL));
    files.push_back(multi_part());
    files.push_back(luminance_chroma(window(0, 0, 11, 7), window(0, 0, 11, 7)));
    for (const std::string& file : files) {
        read(file);
        for (std::size_t size = 0; size < file.size(); ++size) {
            const std::string message = refused(file.substr(0, size));
            if (size >= 4) { EXPECT_THAT(message, HasSubstr("cut short")) << size << " of " << file.size(); }
        }
    }
}

TEST_F(ExrPicture, SurvivesDamage) {
    Imf::Header header(window(0, 0, 7, 17), window(1, 1, 7, 17));
    std::vector<std::string> files;
    for (const Imf::Compression compression :
         {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION,
          Imf::B44_COMPRESSION, Imf::DWAA_COMPRESSION}) {
        header.compression() = compression;
        files.push_back(written(header, rgb, Imf::HALF));
    }
    files.push_back(tiled(header, Imf::MIPMAP_LEVELS));
    files.push_back(multi_part());
    files.push_back(luminance_chroma(window(0, 0, 11, 7), window(0, 0, 11, 7)));
    files.push_back(deep());
    std::mt19937 random(1);
    for (int i = 0; i < 300; ++i) {
        for (std::string file : files) {
            // Of the size, a window's highest bytes may ask for more than a test should take.
            for (auto n = 1 + random() % 3; n > 0; --n) {
                file[random() % file.size()] = static_cast<char>(random() % 3 == 0 ? random() % 4 : random() % 256);
            }
            try {
                read(file);
            } catch (const lightcuts::invalid_input& problem) {
                EXPECT_EQ(std::string(problem.what()).find('\n'), std::string::npos);
            }
        }
    }
}

}  // namespace
