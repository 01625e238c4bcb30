#pragma once

#include <optional>
#include <string>
#include <vector>

namespace benchmark {

struct PlotPoint {
    double x = 0;
    double y = 0;
    std::string label;
};

struct PlotCurve {
    std::string name;
    std::vector<PlotPoint> points;
};

/// A vertical line.
struct PlotMark {
    double x = 0;
    std::string name;
};

/// Curves over two logarithmic axes.
struct Plot {
    std::string title;
    std::string x_title;
    std::string y_title;
    std::vector<PlotCurve> curves;
    std::optional<PlotMark> mark;
    double least_y = 0;      ///< what is below is drawn here
    bool y_is_share = true;  ///< written as a percentage
};

/// The plot as an `svg` element that stands alone. Points whose x is not positive or that are not finite are left
/// out. pre: least_y > 0.
std::string to_svg(const Plot& plot);

/// `text` as the text of an XML element or attribute.
std::string escaped(const std::string& text);

}  // namespace benchmark
