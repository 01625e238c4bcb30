#include <cmath>
#include <iterator>
#include <limits>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <benchmarks/report/plot.hpp>

namespace {

using benchmark::Plot;

struct Dot {
    double x, y;
};

std::vector<Dot> dots(const std::string& svg) {
    static const std::regex circle("<circle cx=\"([0-9.]+)\" cy=\"([0-9.]+)\"");
    std::vector<Dot> result;
    for (std::sregex_iterator it(svg.begin(), svg.end(), circle), end; it != end; ++it) {
        result.push_back({std::stod((*it)[1]), std::stod((*it)[2])});
    }
    return result;
}

Plot plot(std::vector<benchmark::PlotPoint> points) {
    return {"a < b", "seconds", "error", {{"curve", std::move(points)}}, std::nullopt, 1e-4};
}

TEST(Plot, IsLogarithmicInBothAxes) {
    const auto at = dots(to_svg(plot({{0.1, 0.5, ""}, {1.0, 0.05, ""}, {10.0, 0.005, ""}})));
    ASSERT_EQ(at.size(), 3u);
    EXPECT_GT(at[1].x, at[0].x);
    EXPECT_GT(at[1].y, at[0].y);  // pixels run downwards
    EXPECT_NEAR(at[1].x - at[0].x, at[2].x - at[1].x, 0.21);
    EXPECT_NEAR(at[1].y - at[0].y, at[2].y - at[1].y, 0.21);
}

TEST(Plot, TakesWhatHasNoPlaceOnPaper) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    const std::string svg = to_svg(plot({{1.0, 0.0, ""},
                                         {2.0, 1e-9, ""},
                                         {0.0, 0.1, ""},
                                         {4.0, infinite, ""},
                                         {4.0, std::nan(""), ""},
                                         {8.0, 0.1, ""}}));
    const auto at = dots(svg);
    ASSERT_EQ(at.size(), 3u);
    EXPECT_EQ(at[0].y, at[1].y);  // both are too small to be told apart
    EXPECT_GT(at[0].y, at[2].y);
    for (const char* word : {"nan", "inf"}) EXPECT_EQ(svg.find(word), std::string::npos);
    EXPECT_EQ(to_svg(plot({})).find("nan"), std::string::npos);
    EXPECT_EQ(to_svg(plot({{3.0, 0.1, ""}})).find("nan"), std::string::npos);
}

TEST(Plot, ShrinksALongTitle) {
    const auto title_size = [](std::size_t letters) {
        Plot named = plot({{1.0, 0.1, ""}});
        named.title = std::string(letters, 'm');
        const std::string svg = to_svg(named);
        static const std::regex bold("font-size=\"([0-9.]+)\" font-weight=\"bold\"");
        std::smatch match;
        return std::regex_search(svg, match, bold) ? std::stod(match[1]) : 0.0;
    };
    EXPECT_EQ(title_size(20), 14.0);
    EXPECT_GT(title_size(100), 8.0);
    EXPECT_LT(title_size(100), 12.0);
    EXPECT_EQ(title_size(0), 14.0);
}

TEST(Plot, LeavesOutLabelsThatWouldHideOthers) {
    const auto labels = [](std::size_t curves, double apart) {
        Plot many = plot({});
        many.curves.clear();
        double x = 1.0;
        for (std::size_t i = 0; i < curves; ++i, x *= apart) many.curves.push_back({"c", {{x, 0.1, "label"}}});
        const std::string svg = to_svg(many);
        static const std::regex label(">label</text>");
        return std::distance(std::sregex_iterator(svg.begin(), svg.end(), label), std::sregex_iterator());
    };
    EXPECT_EQ(labels(1, 1.0), 1);
    EXPECT_EQ(labels(5, 1.0), 2);  // on either side
    EXPECT_EQ(labels(5, 10.0), 5);
}

TEST(Plot, EscapesItsTexts) {
    const std::string svg = to_svg(plot({{1.0, 0.1, "\"x\" & y"}}));
    EXPECT_NE(svg.find("a &lt; b"), std::string::npos);
    EXPECT_NE(svg.find("&quot;x&quot; &amp; y"), std::string::npos);
}

}  // namespace
