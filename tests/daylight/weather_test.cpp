#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <daylight/weather.hpp>
#include <render/refusal.hpp>
#include "support/temporary_folder.hpp"

#include "daylight/synthetic_weather.hpp"

namespace {

using namespace daylighting;
using ::testing::HasSubstr;

const std::string week = std::string(LIGHTCUTS_TEST_DIRECTORY) + "/daylight/week.epw";

class Epw : public ::testing::Test {
protected:
    TemporaryFolder folder;

    std::string text() const {
        std::ostringstream all;
        all << std::ifstream(week).rdbuf();
        return all.str();
    }
    static std::vector<std::string> lines(const std::string& text) {
        std::vector<std::string> result;
        std::istringstream stream(text);
        for (std::string line; std::getline(stream, line);) result.push_back(line);
        return result;
    }
    static std::string joined(const std::vector<std::string>& lines) {
        std::string text;
        for (const std::string& line : lines) text += line + "\n";
        return text;
    }
    static std::string with_field(std::string line, int field, const std::string& value) {
        std::size_t begin = 0;
        for (int i = 0; i < field; ++i) begin = line.find(',', begin) + 1;
        return line.replace(begin, line.find(',', begin) - begin, value);
    }
    std::string refused(const std::string& content) {
        const std::string path = folder.write("x.epw", content);
        const std::string message = refusal([&] { read_epw(path); });
        EXPECT_THAT(message, HasSubstr(path));
        return message.substr(path.size());
    }
};

TEST_F(Epw, is_read) {
    const Weather weather = read_epw(week);
    EXPECT_EQ(weather.city, "Madeup");
    EXPECT_EQ(weather.place.latitude, 48.2);
    EXPECT_EQ(weather.place.longitude, 16.37);
    EXPECT_EQ(weather.place.time_zone, 1.0);
    ASSERT_EQ(weather.hours.size(), 7u * 24u);
    const WeatherHour& noon = weather.hours[12];
    EXPECT_EQ(noon.month, 3);
    EXPECT_EQ(noon.day, 18);
    EXPECT_EQ(noon.hour, 13);
    EXPECT_EQ(noon.middle().hour, 12.5);
    EXPECT_GT(noon.diffuse_horizontal, 50.0);
    EXPECT_EQ(weather.hours[0].diffuse_horizontal, 0.0);
}

TEST_F(Epw, may_be_of_a_whole_year_with_any_ends_of_lines) {
    EXPECT_EQ(read_epw(folder.write("lf.epw", synthetic_epw())).hours.size(), 8760u);
    EXPECT_EQ(read_epw(folder.write("crlf.epw", synthetic_epw("\r\n"))).hours.size(), 8760u);
    EXPECT_EQ(read_epw(folder.write("mark.epw", "\xEF\xBB\xBF" + synthetic_epw())).hours.size(), 8760u);
}

TEST_F(Epw, with_hours_missing_or_doubled_is_refused) {
    std::vector<std::string> all = lines(text());
    std::vector<std::string> fewer = all;
    fewer.erase(fewer.begin() + 20);
    EXPECT_THAT(refused(joined(fewer)), HasSubstr(":21: hour 14 of 3/18 stands where hour 13 of 3/18 is expected"));
    std::vector<std::string> more = all;
    more.insert(more.begin() + 20, all[20]);
    EXPECT_THAT(refused(joined(more)), HasSubstr(":22: hour 13 of 3/18 stands where hour 14 of 3/18 is expected"));
    std::vector<std::string> cut = all;
    cut.resize(40);
    EXPECT_THAT(refused(joined(cut)), HasSubstr(":41: the file ends before hour 9 of 3/19"));
    std::vector<std::string> longer = all;
    longer.push_back(all.back());
    EXPECT_THAT(refused(joined(longer)), HasSubstr("after the end of the data period"));
}

TEST_F(Epw, with_bad_fields_is_refused) {
    const std::vector<std::string> all = lines(text());
    const auto changed = [&](int field, const std::string& value) {
        std::vector<std::string> other = all;
        other[20] = with_field(other[20], field, value);
        return refused(joined(other));
    };
    EXPECT_THAT(changed(14, "nan"), HasSubstr(":21: the direct normal radiation 'nan' is not a number"));
    EXPECT_THAT(changed(14, "9999"),
                HasSubstr(":21: the direct normal radiation is marked as missing (9999); fill it"));
    EXPECT_THAT(changed(15, "-5"), HasSubstr(":21: the diffuse horizontal radiation '-5' is not a number from 0"));
    EXPECT_THAT(changed(15, ""), HasSubstr(":21: the diffuse horizontal radiation '' is not a number"));
    EXPECT_THAT(changed(7, "cold"), HasSubstr(":21: the dew point 'cold' is not a number"));
    EXPECT_THAT(changed(3, "25"), HasSubstr(":21: the hour '25' is not a number from 1 to 24"));
    EXPECT_THAT(changed(1, "1.5"), HasSubstr(":21: the month is not a whole number"));
    std::vector<std::string> shorter = all;
    shorter[20] = shorter[20].substr(0, 60);
    EXPECT_THAT(refused(joined(shorter)), HasSubstr(" fields; an hour has 35"));
}

TEST_F(Epw, takes_a_usual_dew_point_where_it_is_missing) {
    std::vector<std::string> all = lines(text());
    all[20] = with_field(all[20], 7, "99.9");
    EXPECT_EQ(read_epw(folder.write("x.epw", joined(all))).hours[12].dew_point, 11.0);
}

TEST_F(Epw, with_a_bad_header_is_refused) {
    const std::vector<std::string> all = lines(text());
    EXPECT_THAT(refused(""), HasSubstr("there is no LOCATION"));
    EXPECT_THAT(refused("something else\n"), HasSubstr("there is no LOCATION"));
    EXPECT_THAT(refused(all[0] + "\n"), HasSubstr("there is no line DATA PERIODS"));
    const std::vector<std::pair<std::string, std::string>> periods = {
        {"DATA PERIODS,2,1,Data,Sunday,3/18,3/24", ":8: only one data period"},
        {"DATA PERIODS,1,4,Data,Sunday,3/18,3/24", ":8: only one record an hour"},
        {"DATA PERIODS,1,1,Data,Sunday,13/18,3/24", ":8: the data period's '13/18' is no day"},
        {"DATA PERIODS,1,1", ":8: the data period's '' is no day"}};
    for (const auto& [line, says] : periods) {
        std::vector<std::string> other = all;
        other[7] = line;
        EXPECT_THAT(refused(joined(other)), HasSubstr(says));
    }
    std::vector<std::string> other = all;
    other[0] = with_field(all[0], 6, "480");
    EXPECT_THAT(refused(joined(other)), HasSubstr(":1: the latitude '480' is not a number from -90 to 90"));
}

TEST_F(Epw, of_a_leap_year_may_have_the_29th_of_February_or_not) {
    std::vector<std::string> all = lines(text());
    all[7] = "DATA PERIODS,1,1,Data,Sunday,2/28,3/1";
    const auto year_of = [&](const std::vector<std::string>& days) {
        std::vector<std::string> result(all.begin(), all.begin() + 8);
        for (const std::string& day : days) {
            for (int hour = 1; hour <= 24; ++hour) {
                std::string line = with_field(all[20], 3, std::to_string(hour));
                line = with_field(with_field(line, 1, day.substr(0, 1)), 2, day.substr(2));
                result.push_back(with_field(line, 0, "2004"));
            }
        }
        return folder.write("leap.epw", joined(result));
    };
    EXPECT_EQ(read_epw(year_of({"2/28", "3/1"})).hours.size(), 48u);
    EXPECT_EQ(read_epw(year_of({"2/28", "2/29", "3/1"})).hours.size(), 72u);
}

}  // namespace
