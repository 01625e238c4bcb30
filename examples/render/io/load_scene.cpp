#include "io/load_scene.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <optional>

#include <lightcuts/core/invalid_input.hpp>

#include "io/file_source.hpp"
#include "io/load_gltf.hpp"
#include "io/load_obj.hpp"
#include "io/text_file.hpp"
#include "io/validate.hpp"
#include "motion.hpp"
#include "scenes/builtin.hpp"

namespace render {
namespace {

constexpr std::string_view prefix = "builtin:";
constexpr std::size_t most_lights = 100'000'000;

/// What follows `?` in a built-in scene's name.
struct BuiltinOptions {
    std::optional<std::size_t> lights;
    std::optional<bool> rotated;
};

/// A built-in scene whose number of lights is not part of its name.
struct FixedScene {
    std::string_view name;
    Scene (*make)();
    std::string_view lights;  ///< what sets their number instead
};
constexpr std::array fixed_scenes{FixedScene{"hall", builtin_hall, "--area-points"},
                                  FixedScene{"tableau", builtin_tableau, "--env-lights"},
                                  FixedScene{"wheel", builtin_wheel, "--env-lights"},
                                  FixedScene{"colonnade", builtin_colonnade, "--sky-lights and --indirect"},
                                  FixedScene{"focus", builtin_focus, "--env-lights and --area-points"},
                                  FixedScene{"haze", builtin_haze, "--area-points, --sky-lights and --indirect"},
                                  FixedScene{"foliage", builtin_foliage, "--sky-lights and --indirect"},
                                  FixedScene{"screens", builtin_screens, "--area-points for its two ceiling panels"},
                                  FixedScene{"classroom", builtin_classroom, "--sky-lights and --indirect"},
                                  FixedScene{"test-card", builtin_test_card, "--area-points for its glowing tiles"}};

[[noreturn]] void fail(std::string_view scene, const std::string& problem) {
    throw lightcuts::invalid_input(std::string(scene) + ": " + problem);
}

BuiltinOptions parse_options(std::string_view scene, std::string_view options) {
    BuiltinOptions result;
    while (!options.empty()) {
        const std::size_t end = options.find('&');
        const std::string_view option = options.substr(0, end);
        const std::size_t equals = option.find('=');
        const std::string_view value = equals == std::string_view::npos ? "" : option.substr(equals + 1);
        std::size_t number = 0;
        const auto [rest, error] = std::from_chars(value.data(), value.data() + value.size(), number);
        const bool is_number = error == std::errc{} && rest == value.data() + value.size();
        if (option.starts_with("lights=") && is_number && number > 0 && number <= most_lights) {
            result.lights = number;
        } else if (option.starts_with("rotated=") && is_number && number <= 1) {
            result.rotated = number == 1;
        } else {
            fail(scene, "'" + std::string(option) + "' is no option of a built-in scene; use lights=N or rotated=0");
        }
        options.remove_prefix(end == std::string_view::npos ? options.size() : end + 1);
    }
    return result;
}

Scene load_builtin(std::string_view scene) {
    std::string_view name = scene.substr(prefix.size());
    BuiltinOptions options;
    if (const std::size_t mark = name.find('?'); mark != std::string_view::npos) {
        options = parse_options(scene, name.substr(mark + 1));
        name = name.substr(0, mark);
    }
    if (options.rotated && name != "surfaces") fail(scene, "only the scene 'surfaces' can be rotated; leave it out");
    if (name == "omni") return builtin_omni(options.lights.value_or(10'000));
    if (name == "directional") return builtin_directional(options.lights.value_or(3'000));
    if (name == "surfaces") return builtin_surfaces(options.lights.value_or(30'000), options.rotated.value_or(true));
    if (name == "office") return builtin_office(options.lights.value_or(1'000'000));
    if (name == "night") return builtin_night(options.lights.value_or(150));
    for (const FixedScene& fixed : fixed_scenes) {
        if (name != fixed.name) continue;
        if (options.lights) fail(scene, "its number of lights is not set by lights=; use " + std::string(fixed.lights));
        return fixed.make();
    }
    std::string known;
    for (const std::string& each : builtin_names()) known += (known.empty() ? "" : ", ") + each;
    fail(scene, "there is no such built-in scene; choose one of " + known);
}

}  // namespace

Scene load_scene(std::string_view path_or_builtin, const Shutter& shutter) {
    Scene scene;
    if (path_or_builtin.starts_with(prefix)) {
        scene = load_builtin(path_or_builtin);
        scene.name = path_or_builtin;
    } else {
        const std::filesystem::path path(path_or_builtin);
        const std::string extension = in_lower_case(path.extension().string());
        const DiskFiles files;
        if (extension == ".gltf" || extension == ".glb") {
            scene = load_gltf(path, files, shutter);
        } else if (extension == ".obj") {
            scene = load_obj(path, files);
        } else {
            fail(path_or_builtin,
                 "not a kind of scene that can be read; give a .gltf, .glb or .obj file, or builtin:NAME");
        }
        scene.files = files.taken();
    }
    apply_rigid_motions(scene, shutter);
    set_instants(scene, shutter);
    validate(scene);
    return scene;
}

std::vector<std::string> builtin_names() {
    return {"hall", "omni",  "directional", "surfaces", "tableau",   "wheel",  "focus",    "colonnade",
            "haze", "night", "foliage",     "screens",  "classroom", "office", "test-card"};
}

}  // namespace render
