#include "io/light_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "io/escape.hpp"
#include "io/text_file.hpp"

namespace render {
namespace {

constexpr std::string_view header = "kind,x,y,z,dx,dy,dz,r,g,b";
constexpr std::array<std::string_view, 10> columns{"kind", "x", "y", "z", "dx", "dy", "dz", "r", "g", "b"};

/// The fields of one line.
struct Row {
    const std::filesystem::path& path;
    std::size_t line;
    std::array<std::string_view, columns.size()> fields{};

    [[noreturn]] void fail(const std::string& text) const { fail_at(path, line, text); }

    void split(std::string_view content) {
        std::size_t count = 0;
        for (bool more = true; more; ++count) {
            const std::size_t end = content.find(',');
            if (count < fields.size()) fields[count] = trim(content.substr(0, end));
            more = end != std::string_view::npos;
            if (more) content.remove_prefix(end + 1);
        }
        if (count != fields.size()) {
            fail(std::to_string(count) + " fields; a light has " + std::to_string(fields.size()) + ": " +
                 std::string(header));
        }
    }

    double number(std::size_t column) const {
        const std::string name(columns[column]);
        if (fields[column].empty()) fail(name + " is missing; give it a number");
        const std::optional<double> value = parse_number(fields[column]);
        if (!value || !std::isfinite(static_cast<float>(*value))) {
            fail(name + " '" + excerpt(fields[column]) + "' is not a finite number; correct it");
        }
        return *value;
    }

    glm::dvec3 triple(std::size_t column) const { return {number(column), number(column + 1), number(column + 2)}; }

    /// In the coordinates of a scene with this origin.
    glm::vec3 position(const glm::dvec3& origin) const { return glm::vec3(triple(1) - origin); }

    glm::vec3 direction() const {
        const glm::dvec3 d = triple(4);
        if (d == glm::dvec3(0.0)) fail("the direction dx, dy, dz has zero length; correct it");
        return glm::vec3(glm::normalize(d));
    }

    float radius() const {
        const auto r = static_cast<float>(number(4));
        if (!(r > 0.0f)) fail("the radius dx '" + excerpt(fields[4]) + "' is not positive; correct it");
        return r;
    }

    glm::vec3 intensity() const {
        const glm::vec3 rgb(triple(7));
        for (int i = 0; i < 3; ++i) {
            const auto column = static_cast<std::size_t>(7 + i);
            if (rgb[i] < 0.0f) {
                fail(std::string(columns[column]) + " '" + excerpt(fields[column]) +
                     "' is negative; light cannot be taken away");
            }
        }
        return rgb;
    }

    void require_empty(std::size_t first, std::size_t count = 3) const {
        for (std::size_t column = first; column < first + count; ++column) {
            if (!fields[column].empty()) {
                fail(std::string(columns[column]) + " must be empty for the kind '" + excerpt(fields[0]) + "'");
            }
        }
    }
};

void add_light(const Row& row, const glm::dvec3& origin, Scene& lights) {
    const std::string_view kind = row.fields[0];
    if (kind == "omni") {
        row.require_empty(4);
        lights.omni.push_back({row.position(origin), row.intensity()});
    } else if (kind == "oriented") {
        lights.oriented.push_back({row.position(origin), row.direction(), row.intensity()});
    } else if (kind == "sphere") {
        row.require_empty(5, 2);
        lights.spheres.push_back({row.position(origin), row.radius(), row.intensity()});
    } else if (kind == "directional") {
        row.require_empty(1);
        lights.directional.push_back({row.direction(), row.intensity()});
    } else {
        row.fail("the kind '" + excerpt(kind) + "' is unknown; use omni, oriented, directional or sphere");
    }
}

/// Appends the lights that are not black; returns how many are.
template <class L>
std::size_t append(std::vector<L>& to, const std::vector<L>& from) {
    const std::size_t before = to.size();
    std::copy_if(from.begin(), from.end(), std::back_inserter(to),
                 [](const L& light) { return light.intensity != glm::vec3(0.0f); });
    return from.size() - (to.size() - before);
}

}  // namespace

void add_light_table(const std::filesystem::path& path, Scene& scene, const FileSource& files) {
    const std::string text = files.read(path);
    std::string_view content = text;
    if (content.starts_with(byte_order_mark)) content.remove_prefix(byte_order_mark.size());
    Scene lights;
    bool has_header = false;
    for_each_line(content, [&](std::size_t line, std::string_view line_text) {
        if (trim(line_text).empty()) return;
        if (!has_header) {
            if (trim(line_text) != header) fail_at(path, line, "the header must be " + std::string(header));
            has_header = true;
            return;
        }
        Row row{path, line};
        row.split(line_text);
        add_light(row, scene.origin, lights);
    });
    if (!has_header) fail_at(path, 1, "the file is empty; begin with the header " + std::string(header));

    scene.dropped_lights += append(scene.omni, lights.omni) + append(scene.oriented, lights.oriented) +
                            append(scene.directional, lights.directional) + append(scene.spheres, lights.spheres);
}

}  // namespace render
