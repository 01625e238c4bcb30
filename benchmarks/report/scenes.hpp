#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "options.hpp"
#include "scene.hpp"

namespace benchmark {

/// A picture to be measured: a scene with its lights, seen by one camera.
struct ReportScene {
    std::string name;
    std::shared_ptr<const render::Scene> scene;
    render::Options options;  ///< the renderer's for this scene, size included
    render::Camera camera;
    int width = 0;
    int height = 0;
};

struct ReportSceneOptions {
    std::vector<std::string> scenes;  ///< as scene_options takes them
    std::optional<int> width;         ///< with neither, `pixels` in the camera's own proportions
    std::optional<int> height;
    double pixels = 160 * 90;
    std::uint32_t area_points = 64;  ///< lights per emissive surface, where a scene does not say
    bool first_camera = false;       ///< one camera a scene
};

/// The renderer's built-in scenes, with numbers of lights at which the exhaustive sum takes seconds.
std::vector<std::string> builtin_report_scenes();

/// Loads all scenes. A file is seen by the cameras of the `scene.json` beside it, else by its own first camera.
/// throws: lightcuts::invalid_input for a scene that cannot be rendered, in one line.
std::vector<ReportScene> load_report_scenes(const ReportSceneOptions& options);

}  // namespace benchmark
