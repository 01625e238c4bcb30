#include "choose_camera.hpp"

#include <string>

#include <lightcuts/core/invalid_input.hpp>

#include "moving_view.hpp"
#include "view.hpp"

namespace render {

namespace {

constexpr float default_fov = 45.0f;

Camera scene_camera(const Scene& scene, const std::string& name) {
    if (scene.cameras.empty()) {
        throw lightcuts::invalid_input(scene.name + ": the scene has no camera; give --eye and --target");
    }
    if (name.empty()) return scene.cameras.front();
    std::string names;
    for (const Camera& camera : scene.cameras) {
        if (camera.name == name) return camera;
        names += (names.empty() ? "" : ", ") + camera.name;
    }
    for (const Camera& camera : scene.cameras) {
        if (camera.other_name == name) return camera;
    }
    throw lightcuts::invalid_input(scene.name + ": no camera '" + name + "'; there is " + names);
}

}  // namespace

Camera choose_camera(const Scene& scene, const Options& options) {
    Camera camera;
    if (options.eye) {
        camera.eye = *options.eye;
        camera.target = *options.target;
        camera.up = options.up.value_or(default_up(camera.eye, camera.target));
        camera.vertical_fov = default_fov;
    } else {
        camera = scene_camera(scene, options.camera);
    }
    if (options.fov && camera.height > 0.0) {
        throw usage_error("--fov: the camera '" + camera.name + "' is orthographic, it has no field of view");
    }
    if (options.fov) camera.vertical_fov = *options.fov;
    const std::string where = options.eye ? "--eye, --target" : scene.name + ": camera '" + camera.name + "'";
    require_usable(camera, where);
    for (const CameraPose& pose : camera.at_instants) require_usable(posed(camera, pose), where);
    return camera;
}

}  // namespace render
