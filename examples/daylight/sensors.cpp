#include "sensors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include <glm/geometric.hpp>

#include <lightcuts/core/invalid_input.hpp>
#include <render/io/escape.hpp>
#include <render/io/text_file.hpp>

namespace daylighting {
namespace {

constexpr std::size_t most_sensors = 10'000'000;

}  // namespace

SensorSet sensors_of(const LevelGrid& grid, UpAxis up) {
    const auto refuse = [](const std::string& problem) { throw lightcuts::invalid_input("the grid: " + problem); };
    const glm::dvec3 a = to_compass(grid.corner, up), b = to_compass(grid.opposite, up);
    const char* axis = up == UpAxis::y ? "y" : "z";
    if (a.z != b.z) refuse(std::string("its corners differ in ") + axis + "; give two of one height");
    const double width = std::abs(a.x - b.x), depth = std::abs(a.y - b.y);
    if (!(width > 0.0 && depth > 0.0)) refuse("its corners are not apart; give two opposite ones");
    const double columns = std::max(1.0, std::round(width / grid.spacing));
    const double rows = std::max(1.0, std::round(depth / grid.spacing));
    if (!(columns * rows <= static_cast<double>(most_sensors))) {
        refuse("it has more than " + std::to_string(most_sensors) + " cells; give a larger --spacing");
    }
    SensorSet set;
    set.up = up;
    set.columns = static_cast<std::uint32_t>(columns);
    set.rows = static_cast<std::uint32_t>(rows);
    const glm::vec3 normal = from_compass(glm::vec3(0.0f, 0.0f, 1.0f), up);
    for (std::uint32_t row = 0; row < set.rows; ++row) {
        for (std::uint32_t column = 0; column < set.columns; ++column) {
            const glm::dvec3 at(std::min(a.x, b.x) + width * (column + 0.5) / columns,
                                std::max(a.y, b.y) - depth * (row + 0.5) / rows, a.z);
            set.sensors.push_back({from_compass(at, up), normal});
        }
    }
    return set;
}

SensorSet read_sensors(const std::filesystem::path& path, UpAxis up) {
    const std::string text = render::read_file(path);
    std::string_view content = text;
    if (content.starts_with(render::byte_order_mark)) content.remove_prefix(render::byte_order_mark.size());
    SensorSet set;
    set.up = up;
    render::for_each_line(content, [&](std::size_t line, std::string_view line_text) {
        const std::vector<std::string_view> words = render::split_words(line_text);
        if (words.empty() || words[0].starts_with('#')) return;
        if (words.size() != 6) {
            render::fail_at(path, line, std::to_string(words.size()) + " numbers; a sensor has 6: x y z dx dy dz");
        }
        std::array<double, 6> numbers{};
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const std::optional<double> value = render::parse_number(words[i]);
            if (!value || !std::isfinite(static_cast<float>(*value))) {
                render::fail_at(path, line, "'" + render::excerpt(words[i]) + "' is not a finite number; correct it");
            }
            numbers[i] = *value;
        }
        const glm::dvec3 direction(numbers[3], numbers[4], numbers[5]);
        const double length = glm::length(direction);
        if (!(length > 0.0)) render::fail_at(path, line, "the direction dx dy dz has zero length; correct it");
        if (set.sensors.size() == most_sensors) {
            render::fail_at(path, line, "more than " + std::to_string(most_sensors) + " sensors; split the file");
        }
        set.sensors.push_back({{numbers[0], numbers[1], numbers[2]}, glm::vec3(direction / length)});
    });
    if (set.sensors.empty()) throw lightcuts::invalid_input(path.string() + ": there are no sensors in it");
    return set;
}

}  // namespace daylighting
