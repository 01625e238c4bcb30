#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <daylight/hourly_sky.hpp>
#include <daylight/reinhart_patches.hpp>
#include <daylight/sky_matrix.hpp>
#include <glm/geometric.hpp>
#include <render/refusal.hpp>
#include "support/temporary_folder.hpp"

#include "daylight/sky_matrices.hpp"

namespace {

using namespace daylighting;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double pi = std::numbers::pi;

double radiance_of(std::size_t patch, std::size_t hour, int channel) {
    return 0.1 * static_cast<double>(patch) + 10.0 * static_cast<double>(hour) + 0.37 * channel;
}

TEST(SkyMatrix, is_read_in_every_format_and_order_of_bytes) {
    const std::vector<std::pair<std::string, bool>> kinds = {
        {"ascii", false}, {"float", false}, {"float", true}, {"double", false}, {"double", true}};
    for (const std::size_t patches : {146u, 578u, 2306u}) {
        for (const auto& [format, high_byte_first] : kinds) {
            const std::string bytes = sky_matrix_text(patches, 3, format, radiance_of, high_byte_first);
            const SkyMatrix skies = sky_matrix(bytes, "x.smx");
            EXPECT_EQ(skies.patches, patches);
            EXPECT_EQ(skies.hours, 3u);
            EXPECT_EQ(ReinhartPatches(skies.division).size(), patches);
            for (std::size_t hour = 0; hour < 3; ++hour) {
                ASSERT_EQ(skies.of(hour).size(), patches);
                for (std::size_t p = 0; p < patches; p += 13) {
                    const double expected = 179.0 * (0.265 * radiance_of(p, hour, 0) + 0.670 * radiance_of(p, hour, 1) +
                                                     0.065 * radiance_of(p, hour, 2));
                    EXPECT_NEAR(skies.of(hour)[p], expected, 1e-6 * expected) << format << " " << p << " " << hour;
                }
            }
        }
    }
}

TEST(SkyMatrix, may_have_other_ends_of_lines_and_what_other_programs_wrote) {
    std::string text = sky_matrix_text(146, 1, "ascii", radiance_of);
    text.insert(text.find("NROWS"), "\tNROWS=7\nSOFTWARE= something\nBigEndian = 0\n");
    std::string with_carriage_returns;
    for (const char c : text) with_carriage_returns += c == '\n' ? std::string("\r\n") : std::string(1, c);
    EXPECT_EQ(sky_matrix(text, "x.smx").luminances, sky_matrix(with_carriage_returns, "x.smx").luminances);
    // The format of text is the one that need not be named.
    std::string plain = text;
    plain.erase(plain.find("FORMAT=ascii\n"), 13);
    EXPECT_EQ(sky_matrix(text, "x.smx").luminances, sky_matrix(plain, "x.smx").luminances);
}

TEST(SkyMatrix, of_a_file_is_the_same) {
    const TemporaryFolder folder;
    const std::string bytes = sky_matrix_text(146, 2, "float", radiance_of);
    EXPECT_EQ(read_sky_matrix(folder.write("a.smx", bytes)).luminances, sky_matrix(bytes, "a.smx").luminances);
    EXPECT_THAT(refusal([&] { read_sky_matrix(folder / "absent.smx"); }), HasSubstr("no such file"));
}

std::string refused(const std::string& bytes) {
    const std::string message = refusal([&] { sky_matrix(bytes, "x.smx"); });
    EXPECT_THAT(message, StartsWith("x.smx:"));
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message.substr(5);
}

TEST(SkyMatrix, with_a_bad_header_is_refused) {
    const std::string good = sky_matrix_text(146, 2, "ascii", radiance_of);
    const auto changed = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        return refused(text.replace(text.find(from), from.size(), to));
    };
    EXPECT_THAT(refused(""), HasSubstr("its header has no end"));
    EXPECT_THAT(refused("1 2 3\n"), HasSubstr(":1: does not begin with #?"));
    EXPECT_THAT(refused(good.substr(0, 60)), HasSubstr("its header has no end"));
    EXPECT_THAT(changed("NROWS=146", "NROWS=145"), HasSubstr(":4: NROWS is 145, which is no sky's"));
    EXPECT_THAT(changed("NROWS=146", "NROWS=many"), HasSubstr(":4: NROWS 'many' is not a whole number"));
    EXPECT_THAT(changed("NROWS=146\n", ""), HasSubstr("its header has no NROWS"));
    EXPECT_THAT(changed("NCOLS=2\n", ""), HasSubstr("its header has no NCOLS"));
    EXPECT_THAT(changed("NCOLS=2", "NCOLS=0"), HasSubstr(":5: NCOLS '0' is not a whole number"));
    EXPECT_THAT(changed("NCOLS=2", "NCOLS=1e99"), HasSubstr(":5: NCOLS '1e99' is not a whole number"));
    EXPECT_THAT(changed("NCOMP=3", "NCOMP=1"), HasSubstr(":6: NCOMP is not 3"));
    EXPECT_THAT(changed("FORMAT=ascii", "FORMAT=32-bit_rle_rgbe"), HasSubstr(":7: FORMAT is '32-bit_rle_rgbe'"));
    EXPECT_THAT(changed("NCOMP=3", "BigEndian=2"), HasSubstr(":6: BigEndian is neither 0 nor 1"));
    EXPECT_THAT(changed("gendaymtx -s", "gendaymtx -s -O1"), HasSubstr(":2: gendaymtx -O1 makes solar radiance"));
    EXPECT_THAT(changed("gendaymtx -s", "gendaymtx -5 0.533"), HasSubstr(":2: gendaymtx -5 makes suns"));
    EXPECT_THAT(changed("NCOMP=3", "EXPOSURE=2"), HasSubstr(":6: EXPOSURE says that the numbers are scaled"));
}

TEST(SkyMatrix, that_is_cut_short_or_longer_is_refused) {
    for (const char* format : {"ascii", "float", "double"}) {
        const std::string good = sky_matrix_text(146, 2, format, radiance_of);
        EXPECT_THAT(refused(good.substr(0, good.size() - 5)), HasSubstr("the file is cut short")) << format;
        const std::size_t middle = std::string(format) == "ascii" ? good.rfind('\n', good.size() / 2) + 1
                                                                  : good.size() / 2;
        EXPECT_THAT(refused(good.substr(0, middle)), HasSubstr("fewer than 146 patches x 2 hours x 3")) << format;
        EXPECT_THAT(refused(good + "1 2 3\n"), HasSubstr("more than 146 patches x 2 hours x 3 numbers")) << format;
        // A header that promises more than there is memory for.
        std::string large = good;
        large.replace(large.find("NCOLS=2"), 7, "NCOLS=999999");
        EXPECT_THAT(refused(large), HasSubstr("fewer than 146 patches x 999999 hours")) << format;
    }
}

TEST(SkyMatrix, with_numbers_that_are_no_radiance_is_refused) {
    for (const char* format : {"ascii", "float", "double"}) {
        for (const double bad :
             {-1.0, 2e9, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
            const std::string text = sky_matrix_text(146, 2, format, [&](std::size_t p, std::size_t h, int c) {
                return p == 17 && h == 1 && c == 2 ? bad : 1.0;
            });
            EXPECT_THAT(refused(text), HasSubstr("row 18, column 2: '")) << format << " " << bad;
        }
    }
    std::string text = sky_matrix_text(146, 1, "ascii", [](std::size_t, std::size_t, int) { return 1.0; });
    EXPECT_THAT(refused(text.replace(text.rfind("1\n"), 1, "x")), HasSubstr("row 146, column 1: 'x' is not"));
}

/// What a plane gets from one hour of a block.
double illuminance(const DirectionTree& directions, const SkyBlock& block, const glm::vec3& normal) {
    double sum = 0.0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        sum += static_cast<double>(std::max(0.0f, glm::dot(normal, directions.directions[i])) * block.light()[i][0]);
    }
    return sum;
}

const std::vector<glm::vec3> normals = {{0, 0, 1}, {1, 0, 0},       {0, -1, 0},       {-1, 0, 0},
                                        {0, 1, 0}, {0.6f, 0, 0.8f}, {0, -0.8f, 0.6f}, {-0.6f, 0, 0.8f}};

TEST(SkyMatrix, of_an_even_sky_lights_planes_as_an_even_sky_does) {
    const DirectionTree directions = make_direction_tree(16384);
    const Setting setting{.up = UpAxis::z};
    for (const std::size_t patches : {146u, 2306u}) {
        // 50 cd/m^2 above, 20 below.
        const auto skies = sky_matrix(sky_matrix_text(patches, 8760, "float",
                                                      [](std::size_t p, std::size_t h, int) {
                                                          return h > 0 ? 0.0 : (p == 0 ? 20.0 : 50.0) / 179.0;
                                                      }),
                                      "x.smx");
        const std::vector<LitHour> hours = lit_hours(skies, calendar_year(8760), directions, setting);
        ASSERT_EQ(hours.size(), 1u);
        EXPECT_FALSE(hours[0].has_sun());
        EXPECT_NEAR(hours[0].diffuse_illuminance, 50.0 * pi, 1e-4);
        SkyBlock block(directions, setting);
        block.fill(hours);
        for (const glm::vec3& n : normals) {
            const double above = 0.5 * (1.0 + static_cast<double>(n.z));
            const double expected = pi * (50.0 * above + 20.0 * (1.0 - above));
            EXPECT_NEAR(illuminance(directions, block, n), expected, 2e-3 * expected) << n.z;
        }
    }
}

TEST(SkyMatrix, gives_each_patch_the_light_of_its_solid_angle_wherever_it_is) {
    // Each lit alone, those by the horizon too, in which few directions lie; fewer directions than patches.
    Weather noon;
    noon.place = {48.0, 0.0, 0.0};
    noon.hours = {{2001, 6, 21, 12, 5.0, 0.0, 100.0}};
    for (const std::size_t count : {1024u, 8192u}) {
        const DirectionTree directions = make_direction_tree(count);
        const Setting setting{.up = UpAxis::z};
        const ReinhartPatches patches(2);
        for (std::size_t lit = 1; lit < patches.size(); lit += 7) {
            const auto one = [&](std::size_t p, std::size_t, int) { return p == lit ? 1000.0 / 179.0 : 0.0; };
            const auto skies = sky_matrix(sky_matrix_text(patches.size(), 1, "float", one), "x.smx");
            SkyBlock block(directions, setting);
            block.fill(lit_hours(skies, noon, directions, setting));
            double sum = 0.0;
            for (const HourValues& light : block.light()) sum += static_cast<double>(light[0]);
            EXPECT_NEAR(sum, 1000.0 * patches.solid_angle(lit), 1e-4 * sum) << lit;
        }
    }
}

TEST(SkyMatrix, of_a_weathers_sky_is_that_sky_but_for_the_size_of_patches) {
    const DirectionTree directions = make_direction_tree(16384);
    const Setting setting{.up = UpAxis::z, .turned = 25.0, .ground_albedo = 0.3};
    Weather weather;
    weather.place = {48.0, 0.0, 0.0};
    double coarse = 0.0, fine = 0.0;
    for (const auto& [direct, diffuse] :
         std::vector<std::pair<double, double>>{{0.0, 150.0}, {400.0, 200.0}, {800.0, 90.0}}) {
        weather.hours = {{2001, 6, 21, 10, 5.0, direct, diffuse}};
        const std::vector<LitHour> straight = lit_hours(weather, directions, setting);
        ASSERT_EQ(straight.size(), 1u);
        SkyBlock block(directions, setting);
        block.fill(straight);
        std::vector<double> expected;
        for (const glm::vec3& n : normals) expected.push_back(illuminance(directions, block, n));
        const double on_ground = straight[0].diffuse_illuminance + straight[0].direct_illuminance * straight[0].sun.z;
        for (const int division : {1, 4}) {
            // As gendaymtx does: a patch has the luminance of its middle, all are scaled to the sky's illuminance.
            const ReinhartPatches patches(division);
            double level = 0.0;
            for (std::size_t p = 1; p < patches.size(); ++p) {
                level += straight[0].shape.luminance(patches.center(p), straight[0].sun) * patches.projected(p);
            }
            const auto skies = sky_matrix(
                sky_matrix_text(patches.size(), 1, "double",
                                [&](std::size_t p, std::size_t, int) {
                                    const double luminance = p == 0 ? 0.3 / pi * on_ground
                                                                    : straight[0].shape.luminance(patches.center(p),
                                                                                                  straight[0].sun) *
                                                                          straight[0].diffuse_illuminance / level;
                                    return luminance / 179.0;
                                }),
                "x.smx");
            const std::vector<LitHour> hours = lit_hours(skies, weather, directions, setting);
            ASSERT_EQ(hours.size(), 1u);
            EXPECT_EQ(hours[0].direct_illuminance, straight[0].direct_illuminance);
            EXPECT_EQ(hours[0].towards_sun, straight[0].towards_sun);
            EXPECT_NEAR(hours[0].diffuse_illuminance, straight[0].diffuse_illuminance,
                        1e-6 * straight[0].diffuse_illuminance);
            SkyBlock by_patches(directions, setting);
            by_patches.fill(hours);
            double& farthest = division == 1 ? coarse : fine;
            for (std::size_t i = 0; i < normals.size(); ++i) {
                const double off = illuminance(directions, by_patches, normals[i]) / expected[i] - 1.0;
                farthest = std::max(farthest, std::abs(off));
            }
        }
    }
    EXPECT_LT(coarse, 0.03);
    EXPECT_LT(fine, 0.004);
    EXPECT_LT(fine, 0.5 * coarse);
}

TEST(CalendarYear, has_the_hours_of_a_year) {
    EXPECT_EQ(calendar_year(8760).hours.size(), 8760u);
    const Weather leap = calendar_year(8784);
    EXPECT_EQ(leap.hours.size(), 8784u);
    EXPECT_EQ(leap.hours[59 * 24].day, 29);
    EXPECT_EQ(leap.hours.back().month, 12);
    EXPECT_EQ(leap.hours.back().day, 31);
    EXPECT_EQ(leap.hours.back().hour, 24);
    EXPECT_THAT(refusal([] { calendar_year(168); }), HasSubstr("168 hours are not a year"));
}

}  // namespace
