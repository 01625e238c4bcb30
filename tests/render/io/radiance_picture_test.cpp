#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <render/io/picture.hpp>
#include <render/io/primaries.hpp>
#include <render/io/radiance_picture.hpp>
#include <render/io/radiance_pixels.hpp>

#include "render/radiance_encoder.hpp"
#include "render/refusal.hpp"

namespace {

using render::Picture;
using testing::HasSubstr;

using Encoder = std::string (*)(const Scanline&);
constexpr Encoder encoders[] = {flat, old_encoded, new_encoded};

const std::string rgbe_format = "FORMAT=32-bit_rle_rgbe\n";

Picture read(const std::string& file) { return render::radiance_picture(file, "a.hdr"); }

std::string refused(const std::string& file) {
    return refusal([&] { read(file); });
}

/// The radiance of a pixel, by the definition.
glm::vec3 radiance_of(const Rgbe& pixel) {
    if (pixel[3] == 0) return glm::vec3(0.0f);
    const auto value = [&](std::size_t c) { return std::ldexp(static_cast<float>(pixel[c]), pixel[3] - 136); };
    return {value(0), value(1), value(2)};
}

/// Pixels of random mantissas and exponents, equal neighbors among them in runs of all lengths.
std::vector<Scanline> random_lines(std::size_t length, std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    const auto byte = [&](unsigned from, unsigned to) {
        return static_cast<std::uint8_t>(from + random() % (to - from + 1));
    };
    std::vector<Scanline> lines(count);
    for (Scanline& line : lines) {
        while (line.size() < length) {
            // At least one mantissa has its highest bit, as in all pixels that are no repeat counts.
            const Rgbe pixel{byte(128, 255), byte(0, 255), byte(0, 255), byte(1, 255)};
            const std::size_t run = random() % 3 == 0 ? 1 + random() % (random() % 4 == 0 ? 700 : 9) : 1;
            line.insert(line.end(), std::min(run, length - line.size()), pixel);
        }
    }
    return lines;
}

std::string pixels_of(const std::vector<Scanline>& lines, Encoder encode) {
    std::string bytes;
    for (const Scanline& line : lines) bytes += encode(line);
    return bytes;
}

void expect_rows(const Picture& picture, const std::vector<Scanline>& rows, const std::string& what) {
    ASSERT_EQ(picture.height, static_cast<int>(rows.size())) << what;
    ASSERT_EQ(picture.width, static_cast<int>(rows[0].size())) << what;
    std::size_t i = 0;
    for (const Scanline& row : rows) {
        for (const Rgbe& pixel : row) {
            ASSERT_EQ(picture.pixels[i], radiance_of(pixel)) << what << ", pixel " << i;
            ++i;
        }
    }
}

std::string size_line(const std::vector<Scanline>& rows) {
    return "-Y " + std::to_string(rows.size()) + " +X " + std::to_string(rows[0].size());
}

/// A map of two colors as programs write it, each row encoded in turn differently.
std::string small_file(const std::string& lines = rgbe_format) {
    const auto rows = random_lines(9, 4, 5);
    return radiance_file(lines, size_line(rows),
                         new_encoded(rows[0]) + old_encoded(rows[1]) + flat(rows[2]) + new_encoded(rows[3]));
}

TEST(RadiancePicture, IsWhatWasEncoded) {
    for (const std::size_t width : {1u, 2u, 7u, 8u, 9u, 127u, 128u, 129u, 300u, 1000u}) {
        const auto rows = random_lines(width, 5, static_cast<unsigned>(width));
        for (const Encoder encode : encoders) {
            if (encode == new_encoded && width < 8) continue;
            const std::string what = std::to_string(width) + (encode == flat          ? " flat"
                                                              : encode == old_encoded ? " old"
                                                                                      : " new");
            expect_rows(read(radiance_file(rgbe_format, size_line(rows), pixels_of(rows, encode))), rows, what);
        }
    }
}

TEST(RadiancePicture, HoldsAsManyDifferentPixelsAsAByteCounts) {
    Scanline line;
    for (int i = 0; i < 128; ++i) {
        const auto byte = [&](int factor) { return static_cast<std::uint8_t>(128 + factor * i % 128); };
        line.push_back({byte(1), byte(3), byte(5), byte(7)});
    }
    const std::string bytes = new_encoded(line);
    ASSERT_EQ(bytes[4], '\x80');
    expect_rows(read(radiance_file(rgbe_format, size_line({line}), bytes)), {line}, "no runs");
}

TEST(RadiancePicture, MayMixEncodingsOfScanlines) {
    const auto rows = random_lines(40, 6, 1);
    std::string bytes;
    for (std::size_t y = 0; y < rows.size(); ++y) bytes += encoders[y % 3](rows[y]);
    expect_rows(read(radiance_file(rgbe_format, size_line(rows), bytes)), rows, "mixed");
}

TEST(RadiancePicture, HoldsRunsOfMoreThanAByteCounts) {
    const Rgbe gray{128, 128, 128, 129}, red{200, 0, 0, 130};
    Scanline line(70000, gray);
    line[69999] = red;
    const std::string bytes = old_encoded(line);
    EXPECT_EQ(bytes.size(), 5u * 4u);
    expect_rows(read(radiance_file(rgbe_format, size_line({line}), bytes)), {line}, "long");
    // A count of zero is a place that is not needed.
    const std::string zero = bytes_of(gray) + bytes_of({1, 1, 1, 0}) + bytes_of({1, 1, 1, 1});
    expect_rows(read(radiance_file(rgbe_format, "-Y 1 +X 257", zero)), {Scanline(257, gray)}, "zero");
}

TEST(RadiancePicture, IsNotEncodedAnewBelow8AndAbove32767Pixels) {
    for (const std::size_t width : {7u, 40000u}) {
        Scanline line = random_lines(width, 1, 3)[0];
        line[0] = {2, 2, static_cast<std::uint8_t>(width >> 8), static_cast<std::uint8_t>(width & 255)};
        expect_rows(read(radiance_file(rgbe_format, size_line({line}), flat(line) + "rest")), {line}, "edge");
    }
}

TEST(RadiancePicture, MayBeFlatAndLookEncoded) {
    // The first pixel says what an encoded scanline of 64 pixels begins with, or of another length.
    for (const int low : {64, 65}) {
        auto rows = random_lines(64, 3, 9);
        rows[1][0] = {2, 2, 0, static_cast<std::uint8_t>(low)};
        const std::string file = radiance_file(rgbe_format, size_line(rows), pixels_of(rows, flat));
        expect_rows(read(file), rows, "flat");
        // Bytes too many or too few tell that it is not flat.
        EXPECT_THAT(refused(file + "x"), HasSubstr("scanline 2 of 3"));
    }
}

TEST(RadiancePicture, MayBeFollowedByOtherBytes) {
    const auto rows = random_lines(16, 3, 4);
    for (const Encoder encode : encoders) {
        const std::string file = radiance_file(rgbe_format, size_line(rows), pixels_of(rows, encode));
        expect_rows(read(file + std::string(200, '\0')), rows, "padded");
        expect_rows(read(file + "\n"), rows, "newline");
    }
    // Encoded and padded to the size of flat ones.
    const Scanline line(64, Rgbe{128, 16, 8, 130});
    std::string bytes = old_encoded(line);
    bytes.resize(64 * 4);
    expect_rows(read(radiance_file(rgbe_format, "-Y 1 +X 64", bytes)), {line}, "old, padded");
}

TEST(RadiancePicture, HasEightOrdersOfPixels) {
    constexpr int width = 11, height = 9;
    const auto rows = random_lines(width, height, 2);
    const std::string sizes[2] = {" " + std::to_string(width), " " + std::to_string(height)};
    for (const bool by_columns : {false, true}) {
        for (const bool left : {false, true}) {
            for (const bool up : {false, true}) {
                std::vector<Scanline> lines(by_columns ? width : height);
                for (int i = 0; i < static_cast<int>(lines.size()); ++i) {
                    for (int j = 0; j < (by_columns ? height : width); ++j) {
                        const int column = by_columns ? i : j, row = by_columns ? j : i;
                        const int x = left ? width - 1 - column : column, y = up ? height - 1 - row : row;
                        lines[static_cast<std::size_t>(i)].push_back(
                            rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)]);
                    }
                }
                const std::string x = (left ? "-X" : "+X") + sizes[0], y = (up ? "+Y" : "-Y") + sizes[1];
                const std::string resolution = by_columns ? x + " " + y : y + " " + x;
                for (const Encoder encode : encoders) {
                    expect_rows(read(radiance_file(rgbe_format, resolution, pixels_of(lines, encode))), rows,
                                resolution);
                }
            }
        }
    }
}

TEST(RadiancePicture, PadsItsResolutionWithSpaces) {
    const auto rows = random_lines(12, 2, 6);
    expect_rows(read(radiance_file(rgbe_format, "-Y        2 +X       12", pixels_of(rows, flat))), rows, "padded");
}

TEST(RadiancePicture, TakesPowersOfTwoAsTheyAre) {
    const std::string file = radiance_file(rgbe_format, "-Y 1 +X 4",
                                           bytes_of({128, 64, 32, 129}) + bytes_of({128, 1, 0, 136}) +
                                               bytes_of({255, 255, 255, 0}) + bytes_of({255, 128, 0, 255}));
    const Picture picture = read(file);
    EXPECT_EQ(picture.pixels[0], glm::vec3(1.0f, 0.5f, 0.25f));
    EXPECT_EQ(picture.pixels[1], glm::vec3(128.0f, 1.0f, 0.0f));
    EXPECT_EQ(picture.pixels[2], glm::vec3(0.0f));
    EXPECT_EQ(picture.pixels[3], glm::vec3(std::ldexp(255.0f, 119), std::ldexp(128.0f, 119), 0.0f));
}

TEST(RadiancePicture, HasItsExposureAndColorCorrectionUndone) {
    const std::string pixel = bytes_of({128, 64, 32, 131});  // 4 2 1
    const auto first = [&](const std::string& lines) {
        return read(radiance_file(lines, "-Y 1 +X 1", pixel)).pixels[0];
    };
    EXPECT_EQ(first(rgbe_format), glm::vec3(4, 2, 1));
    EXPECT_EQ(first("EXPOSURE=4\n" + rgbe_format), glm::vec3(1, 0.5, 0.25));
    EXPECT_EQ(first(rgbe_format + "EXPOSURE= 4.000e+00\nEXPOSURE=.5\n"), glm::vec3(2, 1, 0.5));
    EXPECT_EQ(first("COLORCORR=1 2 4\n"), glm::vec3(4, 1, 0.25));
    EXPECT_EQ(first("COLORCORR= 1 2 4\nEXPOSURE=2\nCOLORCORR=2 1 0.5\n"), glm::vec3(1, 0.5, 0.25));
    // Of pictures that this one was made of, whose headers are indented, and in comments.
    EXPECT_EQ(first("a.hdr:\n\tEXPOSURE=4\n# EXPOSURE=4\nCOMMENT=EXPOSURE=4\nVIEW= -vp 0 0 0\n"), glm::vec3(4, 2, 1));

    for (const char* line : {"EXPOSURE=0", "EXPOSURE=-1", "EXPOSURE=nan", "EXPOSURE=inf", "EXPOSURE=", "EXPOSURE=1 2",
                             "EXPOSURE=bright", "EXPOSURE=1e-200", "COLORCORR=1 1", "COLORCORR=1 0 1"}) {
        EXPECT_THAT(refused(radiance_file(std::string(line) + "\n", "-Y 1 +X 1", pixel)), HasSubstr(line));
    }
}

TEST(RadiancePicture, NeedsNoFormatAndAnyProgramsName) {
    const auto rows = random_lines(8, 2, 7);
    const std::string rest = "\n\n-Y 2 +X 8\n" + pixels_of(rows, new_encoded);
    expect_rows(read("#?AUTOPANO11" + rest), rows, "other program");
    expect_rows(read("#?" + rest), rows, "no program");
    expect_rows(read("#?RGBE\nFORMAT= 32-bit_rle_rgbe \nGAMMA=1" + rest), rows, "spaces");
    EXPECT_THAT(refused("#?RADIANCE\nFORMAT=Radiance_rle_spectra" + rest), HasSubstr("Radiance_rle_spectra"));
}

/// From RGB of Radiance's primaries to CIE XYZ, by the primaries' chromaticities and the white.
glm::dvec3 xyz_of(const glm::dvec3& rgb) {
    const glm::dmat3 directions(glm::dvec3(0.64, 0.33, 0.03), glm::dvec3(0.29, 0.60, 0.11),
                                glm::dvec3(0.15, 0.06, 0.79));
    const glm::dvec3 amounts = glm::inverse(directions) * glm::dvec3(1.0);  // equal-energy white
    return directions * (amounts * rgb);
}

TEST(RadiancePicture, OfXyzComesBackAsTheRgbThatItWas) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(0.05, 1.0);
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 rgb = 100.0 * glm::dvec3(uniform(random), uniform(random), uniform(random));
        const double exposure = i % 2 == 0 ? 1.0 / 179.0 : 0.5;
        // Radiance's ra_xyze either multiplies by 179 or says so in the exposure.
        const std::string file = radiance_file(
            "FORMAT=32-bit_rle_xyze\nEXPOSURE=" + std::to_string(exposure * 1e3) + "\nEXPOSURE=1e-3\n", "-Y 1 +X 1",
            bytes_of(rgbe_of(xyz_of(rgb) * 179.0 * exposure)));
        const glm::vec3 back = read(file).pixels[0];
        // A step of a mantissa is 1/128 of the largest of X, Y, Z; the matrix back multiplies it by less than 6.
        for (int c = 0; c < 3; ++c) { EXPECT_NEAR(static_cast<double>(back[c]), rgb[c], 6.0 * 0.5 / 128 * 100.0) << i; }
    }
    // White has all three alike, and stays white.
    const Picture white = read(
        radiance_file("FORMAT=32-bit_rle_xyze\nEXPOSURE=1\n", "-Y 1 +X 1", bytes_of({179, 179, 179, 136})));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(white.pixels[0][c], 1.0f, 1e-6f);
}

TEST(RadiancePicture, OfXyzHasItsColorCorrectionUndoneInRgb) {
    const glm::dvec3 rgb(2.0, 4.0, 1.0);
    const std::string file = radiance_file("FORMAT=32-bit_rle_xyze\nCOLORCORR=1 4 1\n", "-Y 1 +X 1",
                                           bytes_of(rgbe_of(xyz_of(rgb) * 179.0)));
    const glm::vec3 back = read(file).pixels[0];
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(back[c], glm::vec3(2, 1, 1)[c], 0.06f);
}

TEST(RadiancePicture, OfXyzWithoutRgbIsMovedTowardsGray) {
    // No lamp is greener than the line of the spectrum; the luminance is kept.
    const Picture green = read(radiance_file(
        "FORMAT=32-bit_rle_xyze\nEXPOSURE=179\nEXPOSURE=.00558659217877095\nEXPOSURE=.00558659217877095\n", "-Y 1 +X 1",
        bytes_of({32, 128, 8, 129})));
    const glm::dvec3 color(green.pixels[0]);
    EXPECT_GE(std::min({color.r, color.g, color.b}), 0.0);
    EXPECT_NEAR(std::min({color.r, color.g, color.b}), 0.0, 1e-9);
    EXPECT_NEAR(xyz_of(color).y, 1.0, 1e-6);
    EXPECT_GT(color.g, color.r);
}

TEST(RadiancePicture, OfOtherPrimariesBecomesRec709) {
    const auto first = [&](const std::string& primaries, const glm::dvec3& color) {
        return read(radiance_file("PRIMARIES=" + primaries + "\n", "-Y 1 +X 1", bytes_of(rgbe_of(color)))).pixels[0];
    };
    const glm::dvec3 color(1.0, 0.5, 0.25);
    // Those that are taken as Rec. 709: its own, Radiance's, and unknown ones.
    for (const char* primaries : {"0.64 0.33 0.30 0.60 0.15 0.06 0.3127 0.3290",
                                  "0.6400 0.3300 0.2900 0.6000 0.1500 0.0600 0.3333 0.3333", "0 0 0 0 0 0 0 0"}) {
        EXPECT_EQ(first(primaries, color), glm::vec3(color)) << primaries;
    }
    // Rec. 2020's white is that of Rec. 709; its reds and greens are beyond.
    const std::string rec2020 = "0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290";
    const glm::vec3 white = first(rec2020, glm::dvec3(1.0));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], 1.0f, 1e-6f);
    // By the published matrix between the two, to its four digits [ITU-R BT.2087].
    const glm::vec3 converted = first(rec2020, color);
    const glm::vec3 expected(1.6605f * 1.0f - 0.5876f * 0.5f - 0.0728f * 0.25f,
                             -0.1246f * 1.0f + 1.1329f * 0.5f - 0.0083f * 0.25f,
                             -0.0182f * 1.0f - 0.1006f * 0.5f + 1.1187f * 0.25f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(converted[c], expected[c], 2e-4f);
    // What Rec. 709 does not hold is moved towards gray.
    const glm::vec3 red = first(rec2020, {1.0, 0.0, 0.0});
    EXPECT_GE(std::min({red.r, red.g, red.b}), 0.0f);
    EXPECT_NEAR(0.2126f * red.r + 0.7152f * red.g + 0.0722f * red.b, 0.2627f, 1e-3f);
    // Another white stays white.
    const glm::vec3 adapted = first("0.64 0.33 0.21 0.71 0.15 0.06 0.3457 0.3585", glm::dvec3(1.0));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(adapted[c], 1.0f, 1e-5f);

    EXPECT_THAT(refused(radiance_file("PRIMARIES=.3 .3 .3 .3 .3 .3 .3 .3\n", "-Y 1 +X 1", flat({{1, 1, 1, 1}}))),
                HasSubstr("primaries"));
    EXPECT_THAT(refused(radiance_file("PRIMARIES=.3 .3\n", "-Y 1 +X 1", flat({{1, 1, 1, 1}}))), HasSubstr("8 numbers"));
}

TEST(RadiancePicture, IsRefusedWithItsTrueCause) {
    const std::string pixels = flat(Scanline(16, Rgbe{128, 128, 128, 129}));
    EXPECT_THAT(refused(""), HasSubstr("empty"));
    EXPECT_THAT(refused("no picture"), HasSubstr("does not begin with #?"));
    EXPECT_THAT(refused("\x89PNG\r\n\x1a\n"), HasSubstr("PNG"));
    EXPECT_THAT(refused("#?RADIANCE\nEXPOSURE=1"), HasSubstr("cut short in its header"));
    EXPECT_THAT(refused("#?RADIANCE\r\nFORMAT=32-bit_rle_rgbe\r\n\r\n-Y 1 +X 16\r\n" + pixels), HasSubstr("as text"));
    for (const char* size : {"-Y 0 +X 16", "-Y 16 +X 0"}) {
        EXPECT_THAT(refused(radiance_file("", size, pixels)), HasSubstr("0")) << size;
    }
    for (const char* size : {"", "16 1", "-Y 1", "-Y 1 +X", "-Y 1 +Y 16", "+X 1 -X 16", "-Y 1 +X -16", "-Y 1 +X 16 2",
                             "-Z 1 +X 16", "-Y 1 +X 1.6e1", "Y 1 X 16"}) {
        EXPECT_THAT(refused(radiance_file("", size, pixels)), HasSubstr("is no size such as")) << size;
    }
    for (const char* size : {"-Y 1 +X 999999", "-Y 99999 +X 99999", "-Y 2147483648 +X 1",
                             "-Y 99999999999999999999999999 +X 99999999999999999999999999"}) {
        EXPECT_THAT(refused(radiance_file("", size, pixels)), HasSubstr("more than")) << size;
    }
    EXPECT_THAT(refused(radiance_file("", "-Y 2 +X 16", pixels)), HasSubstr("scanline 2 of 2 is cut short"));
    // Runs that are too long for the scanline, of both encodings.
    const std::string run = bytes_of({128, 1, 1, 129}) + bytes_of({1, 1, 1, 16});
    EXPECT_THAT(refused(radiance_file("", "-Y 1 +X 16", run)), HasSubstr("scanline 1 of 1 has a run of 16 pixels"));
    const std::string carried = bytes_of({128, 1, 1, 129}) + bytes_of({1, 1, 1, 1}) + bytes_of({1, 1, 1, 1});
    EXPECT_THAT(refused(radiance_file("", "-Y 1 +X 16", carried)), HasSubstr("a run of 256 pixels where 14"));
    std::string endless = bytes_of({128, 1, 1, 129});
    for (int i = 0; i < 40; ++i) endless += bytes_of({1, 1, 1, static_cast<std::uint8_t>(i < 39 ? 0 : 1)});
    EXPECT_THAT(refused(radiance_file("", "-Y 1 +X 16", endless)), HasSubstr("damaged"));
    for (const char* code : {"\x91", "\x11"}) {
        const std::string encoded = bytes_of({2, 2, 0, 16}) + code + std::string(60, 'x');
        EXPECT_THAT(refused(radiance_file("", "-Y 1 +X 16", encoded)), HasSubstr("a run of 17 pixels where 16"));
    }
    EXPECT_THAT(refused(radiance_file("", "-Y 1 +X 16", new_encoded(Scanline(17)))),
                HasSubstr("17 pixels long instead of 16"));
    // What a message quotes is one line of printable characters.
    const std::string quoted = refused(radiance_file("", "\x1b[2J\x80 -Y " + std::string(5000, '9'), pixels));
    EXPECT_LT(quoted.size(), 300u);
    EXPECT_EQ(quoted.find('\x1b'), std::string::npos);
}

TEST(RadiancePicture, CutShortAnywhereIsRefused) {
    for (const std::string& file :
         {small_file(), small_file("EXPOSURE=2\nCOLORCORR=1 2 3\n"), small_file("FORMAT=32-bit_rle_xyze\n")}) {
        EXPECT_EQ(read(file).size(), 36u);
        for (std::size_t size = 0; size < file.size(); ++size) {
            const std::string message = refused(file.substr(0, size));
            if (size > 1) { EXPECT_THAT(message, HasSubstr("cut short")) << size; }
        }
    }
}

TEST(RadiancePicture, SurvivesDamage) {
    const std::string whole = small_file("EXPOSURE=2\n" + rgbe_format);
    std::mt19937 random(1);
    for (int i = 0; i < 20000; ++i) {
        std::string file = whole;
        for (unsigned n = 1 + random() % 4; n > 0; --n) {
            const auto byte = static_cast<char>(random());
            const char sense = "019+-XY\n =\x01\x02"[random() % 12];
            file[random() % file.size()] = random() % 4 == 0 ? sense : byte;
        }
        try {
            const Picture picture = read(file);
            EXPECT_EQ(picture.size(),
                      static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height));
        } catch (const lightcuts::invalid_input& problem) {
            EXPECT_EQ(std::string(problem.what()).find('\n'), std::string::npos);
        }
    }
}

TEST(RadiancePixels, TakeNoRoomForWhatIsNotThere) {
    // A header may claim what it likes: only runs that are there are unpacked.
    const std::string bytes = bytes_of({128, 128, 128, 129});
    EXPECT_THROW(render::radiance_pixels(bytes, std::size_t(1) << 45, 1), std::runtime_error);
    EXPECT_THROW(render::radiance_pixels(bytes_of({2, 2, 0x7f, 0xff}), 0x7fff, std::size_t(1) << 45),
                 std::runtime_error);
}

}  // namespace
