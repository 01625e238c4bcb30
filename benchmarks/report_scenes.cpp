#include "report_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <lightcuts/core/invalid_input.hpp>

#include "emitters.hpp"
#include "load_scene.hpp"
#include "options.hpp"
#include "scene_sheet.hpp"
#include "surroundings.hpp"
#include "validate.hpp"
#include "view.hpp"

namespace benchmark {

namespace {

/// Of a camera that does not say: the shape of its picture.
constexpr int usual_width = 16;
constexpr int usual_height = 9;

bool is_builtin(const std::string& scene) { return scene.starts_with("builtin:"); }

std::shared_ptr<const render::Scene> load(const std::string& name, std::uint32_t area_points) {
    auto scene = std::make_shared<render::Scene>(render::load_scene(name));
    render::add_emitter_lights(*scene, area_points);
    render::Options usual;
    render::add_surroundings(*scene, usual);
    render::require_lights(*scene);
    if (scene->omni.empty() && scene->oriented.empty() && scene->spots.empty() && scene->directional.empty()) {
        throw lightcuts::invalid_input(name + ": all lights are black; leave the scene out");
    }
    return scene;
}

std::vector<render::SheetCamera> cameras_of(const std::string& name, const render::Scene& scene) {
    if (!is_builtin(name)) {
        if (auto sheet = render::sheet_beside(name)) return sheet->cameras;
    }
    if (scene.cameras.empty()) {
        throw lightcuts::invalid_input(name + ": the scene has no camera; put a scene.json with cameras beside it");
    }
    const render::Camera& camera = scene.cameras.front();
    render::require_usable(camera, name + ": camera '" + camera.name + "'");
    return {{camera, usual_width, usual_height}};
}

/// Sets the size of the picture: what was asked for, the rest in the proportions of the camera's own.
void set_size(ReportScene& scene, const render::SheetCamera& camera, const ReportSceneOptions& options) {
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

std::size_t ReportScene::light_count() const {
    return scene->omni.size() + scene->oriented.size() + scene->spots.size() + scene->directional.size();
}

std::vector<std::string> builtin_report_scenes() {
    std::vector<std::string> scenes;
    for (const std::string& name : render::builtin_names()) {
        if (name == "screens") continue;  // all lights one by one, the reference, would take hours
        const bool counted = name == "directional" || name == "surfaces";
        scenes.push_back("builtin:" + name + (counted ? "?lights=10000" : ""));
    }
    scenes.push_back("builtin:omni?lights=64");
    return scenes;
}

std::vector<ReportScene> load_report_scenes(const ReportSceneOptions& options) {
    std::vector<ReportScene> result;
    for (const std::string& name : options.scenes) {
        const std::shared_ptr<const render::Scene> scene = load(name, options.area_points);
        std::vector<render::SheetCamera> cameras = cameras_of(name, *scene);
        if (options.first_camera) cameras.resize(1);
        for (const render::SheetCamera& camera : cameras) {
            ReportScene& seen = result.emplace_back();
            seen.name = is_builtin(name) ? name : std::filesystem::path(name).stem().string();
            if (cameras.size() > 1) seen.name += ", camera " + camera.camera.name;
            seen.scene = scene;
            seen.camera = camera.camera;
            set_size(seen, camera, options);
        }
    }
    return result;
}

}  // namespace benchmark
