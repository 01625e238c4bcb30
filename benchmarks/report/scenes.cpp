#include "report/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <lightcuts/core/invalid_input.hpp>

#include "io/load_scene.hpp"
#include "io/scene_description.hpp"
#include "prepared_scene.hpp"
#include "scene_options.hpp"
#include "view.hpp"

namespace benchmark {

namespace {

/// Of a camera that does not say: the shape of its picture.
constexpr int usual_width = 16;
constexpr int usual_height = 9;

bool is_builtin(const std::string& scene) { return scene.starts_with("builtin:"); }

/// `name` has the scene's options.
std::shared_ptr<const render::Scene> load(render::Options& options, const std::string& name) {
    auto scene = std::make_shared<render::Scene>(lit_scene(name, options));
    if (scene->light_count() == 0) {
        throw lightcuts::invalid_input(options.scene + ": all lights are black; leave the scene out");
    }
    return scene;
}

std::vector<render::DescribedCamera> cameras_of(const std::string& file, const render::Scene& scene) {
    if (!is_builtin(file)) {
        if (auto description = render::description_beside(file)) return description->cameras;
    }
    if (scene.cameras.empty()) {
        throw lightcuts::invalid_input(file + ": the scene has no camera; put a scene.json with cameras beside it");
    }
    const render::Camera& camera = scene.cameras.front();
    render::require_usable(camera, file + ": camera '" + camera.name + "'");
    return {{camera, usual_width, usual_height}};
}

/// `text` with neither the folders of its files nor the extension of the scene's.
std::string short_name(const std::string& text, const render::Options& options) {
    std::string name = text;
    if (const std::string map = options.env.string(); !map.empty()) {
        name.replace(name.find(map, name.find('?')), map.size(), options.env.filename().string());
    }
    if (!is_builtin(text)) name.replace(0, options.scene.size(), std::filesystem::path(options.scene).stem().string());
    return name;
}

/// Sets the size of the picture: what was asked for, the rest in the proportions of the camera's own.
void set_size(ReportScene& scene, const render::DescribedCamera& camera, const ReportSceneOptions& options) {
    const double aspect = static_cast<double>(camera.width) / camera.height;
    const auto side = [](double length) { return std::max(1, static_cast<int>(std::lround(length))); };
    if (options.width) {
        scene.width = *options.width;
        scene.height = options.height ? *options.height : side(*options.width / aspect);
    } else {
        scene.height = options.height ? *options.height : side(std::sqrt(options.pixels / aspect));
        scene.width = side(scene.height * aspect);
    }
}

}  // namespace

std::vector<std::string> builtin_report_scenes() {
    std::vector<std::string> scenes;
    for (const std::string& name : render::builtin_names()) {
        // All lights one by one, the reference, would take hours.
        if (name == "screens" || name == "focus" || name == "haze" || name == "night" || name == "office") continue;
        const bool counted = name == "directional" || name == "surfaces";
        scenes.push_back("builtin:" + name + (counted ? "?lights=10000" : ""));
    }
    scenes.push_back("builtin:hall?indirect=10000");
    scenes.push_back("builtin:omni?lights=64");
    scenes.push_back("builtin:hall?spp=16");
    return scenes;
}

std::vector<ReportScene> load_report_scenes(const ReportSceneOptions& options) {
    std::vector<ReportScene> result;
    for (const std::string& name : options.scenes) {
        render::Options lighting = scene_options(name, options.area_points);
        const std::shared_ptr<const render::Scene> scene = load(lighting, name);
        std::vector<render::DescribedCamera> cameras = cameras_of(lighting.scene, *scene);
        if (options.first_camera) cameras.resize(1);
        for (const render::DescribedCamera& camera : cameras) {
            ReportScene& seen = result.emplace_back();
            seen.name = short_name(name, lighting);
            if (cameras.size() > 1) seen.name += ", camera " + camera.camera.name;
            seen.scene = scene;
            seen.camera = camera.camera;
            set_size(seen, camera, options);
            seen.options = lighting;
            seen.options.width = seen.width;
            seen.options.height = seen.height;
            seen.options.quiet = true;
        }
    }
    return result;
}

}  // namespace benchmark
