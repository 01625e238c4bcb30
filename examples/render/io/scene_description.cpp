#include "io/scene_description.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <glm/vec3.hpp>
#include <lightcuts/core/invalid_input.hpp>
#include <nlohmann/json.hpp>

#include "io/escape.hpp"
#include "io/text_file.hpp"
#include "view.hpp"

namespace render {

namespace {

using Json = nlohmann::json;

constexpr std::array<std::string_view, 3> keys = {"file", "cameras", "up_axis"};
constexpr std::array<std::string_view, 17> notes = {
    "name",  "title",    "author", "license", "source", "units",    "triangles",       "vertices", "materials",
    "bytes", "textures", "bbox",   "missing", "notes",  "lighting", "punctual_lights", "emissive"};
constexpr std::array<std::string_view, 5> camera_keys = {"eye", "target", "up", "vfov_deg", "resolution"};
constexpr int largest_side = 1 << 16;

/// A value with the place at which it stands, as messages name it.
struct Place {
    const std::filesystem::path& path;
    std::string name;
    const Json& value;

    [[noreturn]] void fail(const std::string& problem) const {
        throw lightcuts::invalid_input(path.string() + ": " + name + (name.empty() ? "" : ": ") + problem);
    }

    Place at(const std::string& key) const {
        if (!value.is_object()) fail("expected an object");
        const auto found = value.find(key);
        if (found == value.end()) fail("'" + key + "' is missing; add it");
        return {path, name.empty() ? key : name + "." + key, *found};
    }

    Place at(std::size_t index) const { return {path, name + "[" + std::to_string(index) + "]", value[index]}; }

    template <class... Lists>
    void require_only(const Lists&... lists) const {
        if (!value.is_object()) fail("expected an object");
        for (const auto& item : value.items()) {
            const auto has = [&](const auto& list) {
                return std::find(list.begin(), list.end(), item.key()) != list.end();
            };
            if (!(has(lists) || ...)) fail("unknown key '" + excerpt(item.key()) + "'; correct or remove it");
        }
    }

    std::string text() const {
        if (!value.is_string()) fail("expected a text");
        return value.get<std::string>();
    }

    double number() const {
        const double number = value.is_number() ? value.get<double>() : NAN;
        // What a float cannot hold cannot be rendered.
        if (!std::isfinite(static_cast<float>(number))) fail("expected a finite number");
        return number;
    }

    void require_numbers(std::size_t count, const char* wanted) const {
        if (!value.is_array() || value.size() != count) fail(std::string("expected ") + wanted);
    }

    glm::dvec3 vector() const {
        require_numbers(3, "three numbers");
        return {at(0).number(), at(1).number(), at(2).number()};
    }

    int side() const {
        const bool good = value.is_number_integer() && value >= 1 && value <= largest_side;
        if (!good) fail("expected a whole number of pixels from 1 to " + std::to_string(largest_side));
        return value.get<int>();
    }
};

DescribedCamera camera_of(const Place& place, std::size_t index) {
    place.require_only(camera_keys);
    DescribedCamera result;
    result.camera.name = std::to_string(index);
    result.camera.eye = place.at("eye").vector();
    result.camera.target = place.at("target").vector();
    result.camera.up = glm::vec3(place.at("up").vector());
    result.camera.vertical_fov = static_cast<float>(place.at("vfov_deg").number());
    const Place resolution = place.at("resolution");
    resolution.require_numbers(2, "a width and a height in pixels");
    result.width = resolution.at(0).side();
    result.height = resolution.at(1).side();
    require_usable(result.camera, place.path.string() + ": " + place.name);
    return result;
}

Json parse(const std::filesystem::path& path, const std::string& text) {
    try {
        return Json::parse(text);
    } catch (const Json::parse_error& e) {
        const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(e.byte, text.size()));
        const auto line = static_cast<std::size_t>(1 + std::count(text.begin(), end, '\n'));
        fail_at(path, line, "not JSON; correct what stands here or just before");
    } catch (const Json::exception&) { fail_at(path, 1, "a number is out of range; correct it"); }
}

}  // namespace

SceneDescription read_scene_description(const std::filesystem::path& path, const FileSource& files) {
    const Json json = parse(path, files.read(path));
    const Place description{path, "", json};
    description.require_only(keys, notes);
    if (json.contains("up_axis") && description.at("up_axis").text() != "+Y") {
        description.at("up_axis").fail("only \"+Y\" is possible; turn the scene");
    }
    SceneDescription result;
    result.file = description.at("file").text();
    const Place cameras = description.at("cameras");
    if (!cameras.value.is_array() || cameras.value.empty()) cameras.fail("expected a list of at least one camera");
    for (std::size_t i = 0; i < cameras.value.size(); ++i) result.cameras.push_back(camera_of(cameras.at(i), i));
    return result;
}

std::optional<SceneDescription> description_beside(const std::filesystem::path& scene_file) {
    const std::filesystem::path path = scene_file.parent_path() / "scene.json";
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return std::nullopt;
    SceneDescription description = read_scene_description(path);
    if (description.file != scene_file.filename().string()) return std::nullopt;
    return description;
}

}  // namespace render
