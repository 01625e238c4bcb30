#include "report/plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace benchmark {

namespace {

constexpr double width = 780, height = 400;
constexpr double left = 66, right = 500, top = 34, bottom = 350;  ///< of the axes
constexpr std::array colors = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#8a6d3b", "#555555"};

template <class... Values>
std::string formatted(const char* format, Values... values) {
    char text[512];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

std::string text_at(double x, double y, const char* attributes, const std::string& text) {
    return formatted("<text x=\"%.1f\" y=\"%.1f\" %s>", x, y, attributes) + escaped(text) + "</text>\n";
}

std::string line(double x0, double y0, double x1, double y1, const char* attributes) {
    return formatted("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" %s/>\n", x0, y0, x1, y1, attributes);
}

/// A logarithmic axis between two pixels.
class Axis {
public:
    /// Covers all `values`, with a little room. pre: values > 0, finite.
    Axis(const std::vector<double>& values, double first_pixel, double last_pixel)
        : first_(first_pixel), last_(last_pixel) {
        if (values.empty()) return;
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        low_ = std::log10(*low);
        high_ = std::log10(*high);
        const double room = std::max(0.07 * (high_ - low_), 0.1);
        low_ -= room;
        high_ += room;
    }

    double pixel(double value) const { return first_ + (last_ - first_) * (std::log10(value) - low_) / (high_ - low_); }

    /// Powers of ten; 2 and 5 times these where there are few.
    std::vector<double> ticks() const {
        std::vector<double> result;
        const bool few = high_ - low_ < 2.5;
        for (int power = static_cast<int>(std::floor(low_)); power <= static_cast<int>(std::ceil(high_)); ++power) {
            for (const double digit : {1.0, 2.0, 5.0}) {
                const double value = digit * std::pow(10.0, power);
                const double at = std::log10(value);
                if ((few || digit == 1.0) && at >= low_ && at <= high_) result.push_back(value);
            }
        }
        return result;
    }

private:
    double first_, last_;
    double low_ = 0, high_ = 1;
};

bool is_drawn(const PlotPoint& p) { return p.x > 0.0 && std::isfinite(p.x) && std::isfinite(p.y); }

std::string axes(const Plot& plot, const Axis& x, const Axis& y) {
    std::string svg;
    for (const double tick : x.ticks()) {
        svg += line(x.pixel(tick), top, x.pixel(tick), bottom, "stroke=\"#dddddd\"");
        svg += text_at(x.pixel(tick), bottom + 16, "text-anchor=\"middle\"", formatted("%g", tick));
    }
    for (const double tick : y.ticks()) {
        svg += line(left, y.pixel(tick), right, y.pixel(tick), "stroke=\"#dddddd\"");
        svg += text_at(left - 6, y.pixel(tick) + 4, "text-anchor=\"end\"",
                       plot.y_is_share ? formatted("%g %%", 100.0 * tick) : formatted("%g", tick));
    }
    svg += formatted("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" stroke=\"#444444\"/>\n",
                     left, top, right - left, bottom - top);
    // A bold letter is about two thirds as wide as high; long titles become small.
    const double letters = static_cast<double>(std::max<std::size_t>(plot.title.size(), 1));
    const double size = std::min(14.0, (width - left) / (0.66 * letters));
    svg += text_at(left, 20, formatted("font-size=\"%.1f\" font-weight=\"bold\"", size).c_str(), plot.title);
    svg += text_at((left + right) / 2, bottom + 36, "text-anchor=\"middle\"", plot.x_title);
    svg += text_at(
        0, 0,
        formatted("text-anchor=\"middle\" transform=\"translate(14 %.1f) rotate(-90)\"", (top + bottom) / 2).c_str(),
        plot.y_title);
    return svg;
}

/// Where labels may stand that hide no other one.
class LabelSpace {
public:
    /// Takes the space of `text` above to the right of a point, or below to the left; false if some of it is taken.
    bool take(double x, double y, bool to_right, const std::string& text) {
        const double wide = 6.2 * static_cast<double>(text.size());
        const Area area = to_right ? Area{x + 5, x + 5 + wide, y - 14, y - 5}
                                   : Area{x - 5 - wide, x - 5, y + 3, y + 12};
        for (const Area& a : taken_) {
            if (a.x0 < area.x1 && area.x0 < a.x1 && a.y0 < area.y1 && area.y0 < a.y1) return false;
        }
        taken_.push_back(area);
        return true;
    }

private:
    struct Area {
        double x0, x1, y0, y1;
    };
    std::vector<Area> taken_;
};

/// `right_labels`: they stand above to the right of their points, else below to the left; where curves run side by
/// side, each is readable if its neighbor's are on the other side. Where there is no room on either, the pointer over
/// the point tells, in the page and where the plot is opened by itself.
std::string curve(const PlotCurve& drawn, const char* color, bool right_labels, double least_y, const Axis& x,
                  const Axis& y, LabelSpace& space) {
    std::string path, marks;
    for (const PlotPoint& p : drawn.points) {
        if (!is_drawn(p)) continue;
        const double px = x.pixel(p.x), py = y.pixel(std::max(p.y, least_y));
        path += formatted("%s%.1f,%.1f", path.empty() ? "" : " ", px, py);
        marks += formatted("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3\" fill=\"%s\">", px, py, color) + "<title>" +
                 escaped(drawn.name + ": " + p.label) + "</title></circle>\n";
        for (const bool to_right : {right_labels, !right_labels}) {
            if (!space.take(px, py, to_right, p.label)) continue;
            const std::string style = formatted("font-size=\"10\" fill=\"%s\"%s", color,
                                                to_right ? "" : " text-anchor=\"end\"");
            marks += text_at(to_right ? px + 5 : px - 5, to_right ? py - 5 : py + 12, style.c_str(), p.label);
            break;
        }
    }
    return "<polyline fill=\"none\" stroke-width=\"1.6\" stroke=\"" + std::string(color) + "\" points=\"" + path +
           "\"/>\n" + marks;
}

std::string legend_entry(std::size_t row, const char* color, const char* dashes, const std::string& name) {
    const double y = top + 12 + 20 * static_cast<double>(row);
    return line(right + 12, y, right + 34, y, formatted("stroke-width=\"2\" stroke=\"%s\" %s", color, dashes).c_str()) +
           text_at(right + 40, y + 4, "font-size=\"11\"", name);
}

}  // namespace

std::string to_svg(const Plot& plot) {
    std::vector<double> xs, ys;
    for (const PlotCurve& c : plot.curves) {
        for (const PlotPoint& p : c.points) {
            if (!is_drawn(p)) continue;
            xs.push_back(p.x);
            ys.push_back(std::max(p.y, plot.least_y));
        }
    }
    const bool marked = plot.mark && plot.mark->x > 0.0;
    if (marked) xs.push_back(plot.mark->x);
    const Axis x(xs, left, right), y(ys, bottom, top);

    std::string svg = formatted(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" width=\"%.0f\" "
        "height=\"%.0f\" font-family=\"sans-serif\" font-size=\"12\" fill=\"#222222\">\n",
        width, height, width, height);
    svg += formatted("<rect width=\"%.0f\" height=\"%.0f\" fill=\"#ffffff\"/>\n", width, height);
    svg += axes(plot, x, y);
    if (marked) {
        const double at = x.pixel(plot.mark->x);
        svg += line(at, top, at, bottom, "stroke=\"#222222\" stroke-dasharray=\"5 4\"");
        svg += legend_entry(plot.curves.size(), "#222222", "stroke-dasharray=\"5 4\"", plot.mark->name);
    }
    LabelSpace labels;
    for (std::size_t i = 0; i < plot.curves.size(); ++i) {
        const char* color = colors[i % colors.size()];
        svg += curve(plot.curves[i], color, i % 2 == 0, plot.least_y, x, y, labels);
        svg += legend_entry(i, color, "", plot.curves[i].name);
    }
    return svg + "</svg>\n";
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&': result += "&amp;"; break;
            case '<': result += "&lt;"; break;
            case '>': result += "&gt;"; break;
            case '"': result += "&quot;"; break;
            default: result += c;
        }
    }
    return result;
}

}  // namespace benchmark
