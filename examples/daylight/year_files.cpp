#include "year_files.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>

#include <lightcuts/core/invalid_input.hpp>
#include <render/false_color.hpp>
#include <render/io/output_file.hpp>
#include <render/io/picture.hpp>

namespace daylighting {
namespace {

constexpr std::uint32_t least_picture_side = 480;
constexpr std::size_t flushed_at = 1 << 20;

/// Text that goes to a file as it grows.
class TextOutput {
public:
    explicit TextOutput(const std::filesystem::path& path) : file_(path) {}

    TextOutput& operator<<(const char* text) {
        text_ += text;
        if (text_.size() >= flushed_at) flush();
        return *this;
    }
    /// In as many digits as are needed after the point, up to `digits`.
    void number(double value, int digits) {
        char buffer[64];
        char* end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, digits).ptr;
        while (digits > 0 && end[-1] == '0') --end;
        if (digits > 0 && end[-1] == '.') --end;
        text_.append(buffer, end);
        if (text_.size() >= flushed_at) flush();
    }
    void commit() {
        flush();
        file_.commit();
    }

private:
    void flush() {
        file_.write(text_);
        text_.clear();
    }

    render::OutputFile file_;
    std::string text_;
};

constexpr std::size_t dark = static_cast<std::size_t>(-1);

/// Of each hour of the weather, which lit hour it is.
std::vector<std::size_t> lit_places(const Weather& weather, std::span<const LitHour> hours) {
    std::vector<std::size_t> places(weather.hours.size(), dark);
    for (std::size_t i = 0; i < hours.size(); ++i) places[hours[i].hour] = i;
    return places;
}

double value_of(const AnnualFigures& f, const std::string& figure) {
    if (figure == "autonomy") return f.autonomy;
    if (figure == "useful") return f.useful_to_3000;
    return figure == "sun" ? f.sun_hours.value_or(0.0) : f.mean;
}

}  // namespace

void write_hourly(const std::filesystem::path& path, const Weather& weather, std::span<const LitHour> hours,
                  const Illuminances& lux) {
    const std::vector<std::size_t> places = lit_places(weather, hours);
    TextOutput out(path);
    out << "month,day,hour";
    for (std::size_t s = 0; s < lux.sensors; ++s) {
        out << ",";
        out.number(static_cast<double>(s), 0);
    }
    out << "\n";
    for (std::size_t h = 0; h < places.size(); ++h) {
        const WeatherHour& hour = weather.hours[h];
        out.number(hour.month, 0);
        out << ",";
        out.number(hour.day, 0);
        out << ",";
        out.number(hour.hour, 0);
        for (std::size_t s = 0; s < lux.sensors; ++s) {
            out << ",";
            out.number(places[h] == dark ? 0.0 : static_cast<double>(lux.of(s)[places[h]]), 1);
        }
        out << "\n";
    }
    out.commit();
}

void write_matrix(const std::filesystem::path& path, const Weather& weather, std::span<const LitHour> hours,
                  const Illuminances& lux) {
    const std::vector<std::size_t> places = lit_places(weather, hours);
    TextOutput out(path);
    out << "#?RADIANCE\nlightcuts-daylight: illuminance, lux; a row each sensor, a column each hour\nNROWS=";
    out.number(static_cast<double>(lux.sensors), 0);
    out << "\nNCOLS=";
    out.number(static_cast<double>(places.size()), 0);
    out << "\nNCOMP=1\nFORMAT=ascii\n\n";
    for (std::size_t s = 0; s < lux.sensors; ++s) {
        for (std::size_t h = 0; h < places.size(); ++h) {
            if (h > 0) out << "\t";
            out.number(places[h] == dark ? 0.0 : static_cast<double>(lux.of(s)[places[h]]), 1);
        }
        out << "\n";
    }
    out.commit();
}

void write_annual(const std::filesystem::path& path, const SensorSet& sensors, std::span<const AnnualFigures> figures,
                  double target) {
    TextOutput out(path);
    out << "sensor,x,y,z,dx,dy,dz,mean_lux,autonomy_";
    out.number(target, 3);
    out << ",useful_100_2000,useful_100_3000,below_100,above_3000,sun_hours\n";
    for (std::size_t i = 0; i < figures.size(); ++i) {
        const Sensor& s = sensors.sensors[i];
        const AnnualFigures& f = figures[i];
        out.number(static_cast<double>(i), 0);
        for (const double value : {s.position.x, s.position.y, s.position.z, static_cast<double>(s.normal.x),
                                   static_cast<double>(s.normal.y), static_cast<double>(s.normal.z)}) {
            out << ",";
            out.number(value, 6);
        }
        out << ",";
        out.number(f.mean, 1);
        for (const double share : {f.autonomy, f.useful_to_2000, f.useful_to_3000, f.too_dark, f.too_bright}) {
            out << ",";
            out.number(share, 4);
        }
        out << ",";
        if (f.sun_hours) out.number(*f.sun_hours, 1);
        out << "\n";
    }
    out.commit();
}

const std::vector<std::string>& figure_names() {
    static const std::vector<std::string> names = {"autonomy", "useful", "sun", "mean"};
    return names;
}

double write_picture(const std::filesystem::path& path, const SensorSet& sensors,
                     std::span<const AnnualFigures> figures, const std::string& figure) {
    if (sensors.columns == 0) {
        throw lightcuts::invalid_input(path.string() + ": only a grid makes a picture; trace one with --grid");
    }
    const bool is_share = figure == "autonomy" || figure == "useful";
    double white = is_share ? 1.0 : 0.0;
    for (const AnnualFigures& f : figures) white = std::max(white, value_of(f, figure));
    if (!(white > 0.0)) white = 1.0;
    const std::uint32_t cell = std::max(1u, least_picture_side / std::max(sensors.columns, sensors.rows));
    const std::uint32_t width = sensors.columns * cell, height = sensors.rows * cell;
    std::vector<glm::vec3> colors(std::size_t{width} * height);
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const std::size_t sensor = std::size_t{y / cell} * sensors.columns + x / cell;
            colors[std::size_t{y} * width + x] = render::false_color(value_of(figures[sensor], figure), white);
        }
    }
    render::write_png(path, static_cast<int>(width), static_cast<int>(height), colors);
    return white;
}

}  // namespace daylighting
