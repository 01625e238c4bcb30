#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include <daylight/weather.hpp>

/// A weather file of a whole year, made by a formula: its text, with `end` after each line.
inline std::string synthetic_epw(const std::string& end = "\n") {
    std::string text = "LOCATION,Madeup,-,AUT,synthetic,0,48.20,16.37,1.0,190.0" + end + "DESIGN CONDITIONS,0" + end +
                       "TYPICAL/EXTREME PERIODS,0" + end + "GROUND TEMPERATURES,0" + end +
                       "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0" + end + "COMMENTS 1,made by a formula" + end +
                       "COMMENTS 2," + end + "DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31" + end;
    constexpr std::array<int, 12> days = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    const daylighting::Place vienna{48.2, 16.37, 1.0};
    int day_of_year = 0;
    for (int month = 1; month <= 12; ++month) {
        for (int day = 1; day <= days[static_cast<std::size_t>(month - 1)]; ++day) {
            ++day_of_year;
            for (int hour = 1; hour <= 24; ++hour) {
                const double height = daylighting::towards_sun(vienna, {2001, month, day, hour - 0.5}).z;
                const double cloud = 0.5 + 0.5 * std::sin(day_of_year * 1.7 + hour * 0.15);
                double direct = 0.0, diffuse = 0.0;
                if (height > 0.01) {
                    direct = std::max(0.0, 1.0 - 1.25 * cloud) * 950.0 * std::exp(-0.13 / (height + 0.03));
                    diffuse = height * (110.0 + 260.0 * cloud * (1.25 - 0.6 * cloud)) + 12.0 * std::sqrt(height);
                }
                char line[256];
                std::snprintf(line, sizeof line,
                              "2001,%d,%d,%d,60,?9,10.0,5.0,70,99400,0,0,300,0,%.0f,%.0f,999999,999999,999999,9999,"
                              "180,2.0,5,5,20.0,77777,9,999999999,10,0.1000,0,88,0.200,0.0,1.0",
                              month, day, hour, direct, diffuse);
                text += line + end;
            }
        }
    }
    return text;
}
