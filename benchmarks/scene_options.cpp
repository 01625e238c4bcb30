#include "scene_options.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include <lightcuts/core/invalid_input.hpp>

namespace benchmark {

namespace {

constexpr std::array<std::string_view, 2> keys_of_builtins = {"lights", "rotated"};
constexpr std::array<std::string_view, 29> keys = {
    "area-points", "env",      "env-lights",     "env-scale",   "env-rotate", "sun-sky",    "turbidity",   "sky-lights",
    "ground",      "indirect", "clamp",          "clamp-ratio", "materials",  "seed",       "spp",         "filter",
    "aperture",    "focus",    "fog-anisotropy", "fog-albedo",  "fog",        "adaptation", "error-ratio", "max-cut",
    "shutter",     "instants", "shutter-shape",  "time",        "pair-sides"};

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

std::string listed() {
    std::string text;
    for (const std::string_view key : keys) text += (text.empty() ? "" : ", ") + std::string(key);
    return text;
}

}  // namespace

render::Options scene_options(const std::string& name, std::uint32_t area_points) {
    const std::size_t mark = name.find('?');
    std::string scene = name.substr(0, mark);
    std::string_view rest = mark == std::string::npos ? "" : std::string_view(name).substr(mark + 1);
    const bool is_builtin = scene.starts_with("builtin:");
    bool has_own = false, has_area_points = false;
    std::vector<std::string> words = {"benchmark"};
    while (!rest.empty()) {
        const std::string option(rest.substr(0, rest.find('&')));
        rest.remove_prefix(std::min(rest.size(), option.size() + 1));
        const std::string key = option.substr(0, option.find('='));
        if (is_builtin && contains(keys_of_builtins, key)) {
            scene += (has_own ? "&" : "?") + option;
            has_own = true;
        } else if (contains(keys, key) && key != option) {
            words.push_back("--" + option);
            has_area_points = has_area_points || key == "area-points";
        } else {
            throw lightcuts::invalid_input(name + ": '" + option + "' is no option of this scene; KEY=VALUE may have " +
                                           "the keys " + listed() + ", and lights with most built-in scenes");
        }
    }
    if (!has_area_points) words.push_back("--area-points=" + std::to_string(area_points));
    words.push_back(scene);
    std::vector<const char*> arguments;
    for (const std::string& word : words) arguments.push_back(word.c_str());
    try {
        return render::parse_options(static_cast<int>(arguments.size()), arguments.data());
    } catch (const render::usage_error& problem) { throw lightcuts::invalid_input(name + ": " + problem.what()); }
}

}  // namespace benchmark
