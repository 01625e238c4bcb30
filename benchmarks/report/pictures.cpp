#include "report/pictures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string_view>

#include <glm/common.hpp>

#include "false_color.hpp"
#include "io/picture.hpp"
#include "options.hpp"
#include "report/plot.hpp"

namespace benchmark {

namespace {

using render::Picture;

std::string base64(const std::vector<char>& bytes) {
    constexpr const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t group = 0;
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        for (std::size_t k = 0; k < 3; ++k) {
            group = group << 8 | (k < count ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
        }
        for (std::size_t k = 0; k < 4; ++k) text += k <= count ? letters[group >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

std::string figure(const Picture& picture, const std::vector<glm::vec3>& colors, const std::string& caption) {
    return "<figure><img alt=\"" + escaped(caption) + "\" src=\"data:image/png;base64," +
           base64(render::png_bytes(picture.width, picture.height, colors)) + "\"><figcaption>" + escaped(caption) +
           "</figcaption></figure>\n";
}

Picture sum(const Picture& a, const Picture& b) {
    Picture result(a.width, a.height);
    for (std::size_t i = 0; i < a.size(); ++i) result.pixels[i] = a.pixels[i] + b.pixels[i];
    return result;
}

Picture difference(const Picture& picture, const Picture& reference, float factor) {
    Picture result(picture.width, picture.height);
    for (std::size_t i = 0; i < picture.size(); ++i) {
        result.pixels[i] = factor * glm::abs(picture.pixels[i] - reference.pixels[i]);
    }
    return result;
}

/// Where the cut size varies; the same everywhere it is no picture.
std::string cut_size_map(const Measurement& m) {
    const Picture::Channel* cuts = m.picture.find("cut_size");
    const std::optional<float> white = white_cut_size(cuts->values);
    if (!white) return {};
    std::vector<glm::vec3> colors;
    for (const float size : cuts->values) {
        colors.push_back(render::false_color(static_cast<double>(size), static_cast<double>(*white)));
    }
    char range[96];
    std::snprintf(range, sizeof range, "cut size: mean %.0f; black 0, white %.0f or more", m.cut_size,
                  static_cast<double>(*white));
    return figure(m.picture, colors, range);
}

}  // namespace

std::optional<float> white_cut_size(std::vector<float> sizes) {
    std::erase_if(sizes, [](float size) { return !(size > 0.0f); });
    if (sizes.empty()) return std::nullopt;
    std::sort(sizes.begin(), sizes.end());
    if (sizes.front() == sizes.back()) return std::nullopt;
    return sizes[(sizes.size() - 1) * 99 / 100];
}

std::vector<const Measurement*> equal_time_settings(const SceneMeasurement& scene) {
    const auto lightcuts = std::find_if(scene.curves.begin(), scene.curves.end(), [](const Curve& c) {
        return std::string_view(c.method->method) == "lightcuts";
    });
    const auto closest = [](const Curve& curve, auto&& distance) {
        return &*std::min_element(
            curve.points.begin(), curve.points.end(),
            [&](const Measurement& a, const Measurement& b) { return distance(a) < distance(b); });
    };
    const double usual = static_cast<double>(render::Options{}.error_ratio);
    const double seconds = closest(*lightcuts, [&](const Measurement& m) {
                               return std::abs(std::log(m.value / usual));
                           })->seconds;
    std::vector<const Measurement*> settings;
    for (const Curve& curve : scene.curves) {
        settings.push_back(
            closest(curve, [&](const Measurement& m) { return std::abs(std::log(m.seconds / seconds)); }));
    }
    return settings;
}

std::string pictures_html(const SceneMeasurement& scene) {
    const Picture& reference = scene.exhaustive.picture;
    const auto seen = [&](const Picture& reflected) { return sum(reflected, scene.emitted); };
    const render::ToneCurve curve = render::tone_curve(seen(reference));
    char caption[256];
    std::snprintf(caption, sizeof caption, "exhaustive sum, %.3g s", scene.exhaustive.seconds);
    std::string html = "<div>" + figure(reference, tone_mapped(seen(reference), curve), caption) + "</div>\n";
    const std::vector<const Measurement*> settings = equal_time_settings(scene);
    for (std::size_t i = 0; i < settings.size(); ++i) {
        const Measurement& m = *settings[i];
        const ReportMethod& method = *scene.curves[i].method;
        std::snprintf(caption, sizeof caption, "%s, %s %s: %.3g s, relative RMSE %.3g %%", method.name,
                      method.parameter, as_text(m.value).c_str(), m.seconds, 100.0 * m.error.relative_rmse);
        html += "<div>" + figure(m.picture, tone_mapped(seen(m.picture), curve), caption);
        html += figure(m.picture, tone_mapped(difference(m.picture, scene.reference_of(method).picture, 16.0f), curve),
                       "16 x difference");
        html += cut_size_map(m) + "</div>\n";
    }
    return html;
}

}  // namespace benchmark
