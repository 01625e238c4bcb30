#include "weather.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string_view>
#include <utility>

#include <lightcuts/core/invalid_input.hpp>
#include <render/io/escape.hpp>
#include <render/io/text_file.hpp>

namespace daylighting {
namespace {

constexpr std::size_t least_fields = 32;  ///< of an hour; older files lack the last ones
constexpr std::size_t most_fields = 36;   ///< with a comma at the end
constexpr double missing_irradiance = 9999.0;
constexpr double missing_dew_point = 99.9;
constexpr double usual_dew_point = 11.0;

/// A day of the period.
struct Day {
    int month = 1;
    int day = 1;
    bool operator==(const Day&) const = default;
};

int days_in(int month, bool is_leap) {
    constexpr std::array<int, 12> days = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    return days[static_cast<std::size_t>(month - 1)] + (month == 2 && is_leap ? 1 : 0);
}

class EpwReader {
public:
    explicit EpwReader(const std::filesystem::path& path) : path_(path) {}

    Weather read(std::string_view text) {
        if (text.starts_with(render::byte_order_mark)) text.remove_prefix(render::byte_order_mark.size());
        render::for_each_line(text, [&](std::size_t line, std::string_view content) {
            line_ = line;
            if (render::trim(content).empty()) return;
            split(content);
            if (in_data_) {
                read_hour();
            } else {
                read_header();
            }
        });
        ++line_;
        if (!has_place_) fail("there is no LOCATION; is this a weather file (EPW)?");
        if (!in_data_) fail("there is no line DATA PERIODS; the file is cut short");
        if (!is_complete_)
            fail("the file ends before " + named(next_, next_hour_) + "; add the hours that are missing");
        return std::move(weather_);
    }

private:
    [[noreturn]] void fail(const std::string& problem) const { render::fail_at(path_, line_, problem); }

    static std::string named(const Day& day, int hour) {
        return "hour " + std::to_string(hour) + " of " + std::to_string(day.month) + "/" + std::to_string(day.day);
    }

    void split(std::string_view line) {
        fields_.clear();
        for (bool more = true; more;) {
            const std::size_t end = line.find(',');
            fields_.push_back(render::trim(line.substr(0, end)));
            more = end != std::string_view::npos;
            if (more) line.remove_prefix(end + 1);
        }
    }

    double number(std::size_t field, const char* name, double least, double most) const {
        const std::string_view text = field < fields_.size() ? fields_[field] : std::string_view();
        const std::optional<double> value = render::parse_number(text);
        if (!value || !(*value >= least && *value <= most)) {
            char range[64];
            std::snprintf(range, sizeof range, "%g to %g", least, most);
            fail(std::string(name) + " '" + render::excerpt(text) + "' is not a number from " + range + "; correct it");
        }
        return *value;
    }
    int whole(std::size_t field, const char* name, int least, int most) const {
        const double value = number(field, name, least, most);
        if (value != std::floor(value)) fail(std::string(name) + " is not a whole number; correct it");
        return static_cast<int>(value);
    }

    void read_header() {
        if (fields_[0] == "LOCATION") {
            if (fields_.size() < 10) fail("LOCATION has " + std::to_string(fields_.size()) + " fields; it needs 10");
            weather_.city = fields_[1];
            weather_.place = {.latitude = number(6, "the latitude", -90.0, 90.0),
                              .longitude = number(7, "the longitude", -180.0, 180.0),
                              .time_zone = number(8, "the time zone", -12.0, 14.0)};
            has_place_ = true;
        } else if (fields_[0] == "DATA PERIODS") {
            if (whole(1, "the number of data periods", 1, 1000) != 1) fail("only one data period can be read");
            if (whole(2, "the number of records an hour", 1, 60) != 1) fail("only one record an hour can be read");
            next_ = day_of(5);
            last_ = day_of(6);
            in_data_ = true;
        }
    }

    /// A field such as ` 1/31`, or 1/31/2001.
    Day day_of(std::size_t field) const {
        const std::string_view text = field < fields_.size() ? fields_[field] : std::string_view();
        const std::size_t slash = text.find('/');
        const std::string_view rest = slash == std::string_view::npos ? std::string_view() : text.substr(slash + 1);
        const auto month = render::parse_number(render::trim(text.substr(0, slash)));
        const auto day = render::parse_number(render::trim(rest.substr(0, rest.find('/'))));
        const bool is_month = month && *month >= 1.0 && *month <= 12.0 && *month == std::floor(*month);
        if (!is_month || !day || !(*day >= 1.0 && *day <= days_in(static_cast<int>(*month), true)) ||
            *day != std::floor(*day)) {
            fail("the data period's '" + render::excerpt(text) + "' is no day such as 1/31; correct it");
        }
        return {static_cast<int>(*month), static_cast<int>(*day)};
    }

    void read_hour() {
        if (is_complete_) fail("an hour after the end of the data period; is DATA PERIODS right?");
        if (fields_.size() < least_fields || fields_.size() > most_fields) {
            fail(std::to_string(fields_.size()) + " fields; an hour has 35");
        }
        WeatherHour hour;
        hour.year = whole(0, "the year", 1800, 2200);
        hour.month = whole(1, "the month", 1, 12);
        hour.day = whole(2, "the day", 1, days_in(hour.month, true));
        hour.hour = whole(3, "the hour", 1, 24);
        // Files of typical years leave the 29th of February out whatever the year.
        if (next_ == Day{2, 29} && next_hour_ == 1 && hour.month == 3) next_ = {3, 1};
        if (Day{hour.month, hour.day} != next_ || hour.hour != next_hour_) {
            fail(named({hour.month, hour.day}, hour.hour) + " stands where " + named(next_, next_hour_) +
                 " is expected; hours are missing, doubled or out of order");
        }
        const double dew_point = number(7, "the dew point", -110.0, missing_dew_point);
        hour.dew_point = dew_point == missing_dew_point ? usual_dew_point : dew_point;
        hour.direct_normal = irradiance(14, "the direct normal radiation");
        hour.diffuse_horizontal = irradiance(15, "the diffuse horizontal radiation");
        weather_.hours.push_back(hour);
        advance();
    }

    double irradiance(std::size_t field, const char* name) const {
        const double value = number(field, name, 0.0, 999999.0);
        if (value >= missing_irradiance) {
            fail(std::string(name) + " is marked as missing (" + std::string(fields_[field]) + "); fill it in");
        }
        return value;
    }

    void advance() {
        if (++next_hour_ <= 24) return;
        next_hour_ = 1;
        is_complete_ = next_ == last_;
        if (next_.day < days_in(next_.month, true)) {
            ++next_.day;
        } else {
            next_ = {next_.month % 12 + 1, 1};
        }
    }

    const std::filesystem::path& path_;
    Weather weather_;
    std::vector<std::string_view> fields_;
    std::size_t line_ = 0;
    bool has_place_ = false;
    bool in_data_ = false;
    bool is_complete_ = false;
    Day next_, last_;
    int next_hour_ = 1;
};

}  // namespace

Weather calendar_year(std::size_t hours) {
    const bool is_leap = hours == 8784;
    if (hours != 8760 && !is_leap) {
        throw lightcuts::invalid_input(std::to_string(hours) + " hours are not a year of 8760 or 8784");
    }
    Weather weather;
    for (int month = 1; month <= 12; ++month) {
        for (int day = 1; day <= days_in(month, is_leap); ++day) {
            for (int hour = 1; hour <= 24; ++hour) weather.hours.push_back({is_leap ? 2000 : 2001, month, day, hour});
        }
    }
    return weather;
}

Weather epw_weather(std::string_view text, const std::filesystem::path& path) { return EpwReader(path).read(text); }

Weather read_epw(const std::filesystem::path& path) {
    const std::string text = render::read_file(path);
    return epw_weather(text, path);
}

}  // namespace daylighting
