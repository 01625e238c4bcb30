#include "prepared_scene.hpp"

#include <string>
#include <utility>

#include <lightcuts/core/invalid_input.hpp>
#include <render/io/map_picture.hpp>

namespace relight {

namespace {

Mesh mesh_of(const RelightFile& file, render::Scene scene, const std::filesystem::path& cut_file) {
    file.require_scene(scene);
    Mesh mesh = refined(std::move(scene), file.preparation().longest_edge);
    if (mesh.sites.sites.size() != file.preparation().sites) {
        throw lightcuts::invalid_input(cut_file.string() + ": has cuts for " +
                                       std::to_string(file.preparation().sites) + " places of the mesh, which has " +
                                       std::to_string(mesh.sites.sites.size()) + "; prepare it anew");
    }
    return mesh;
}

}  // namespace

PreparedScene::PreparedScene(const std::filesystem::path& cut_file, render::Scene scene,
                             const render::RayTracer& tracer)
    : file(cut_file), mesh(mesh_of(file, std::move(scene), cut_file)), rays(mesh.scene, tracer) {}

std::vector<std::filesystem::path> inputs_of(const Options& options, const render::Scene& scene) {
    std::vector<std::filesystem::path> inputs = scene.files;
    inputs.push_back(options.cut_file);
    inputs.push_back(options.map);
    return inputs;
}

render::Environment read_environment(const Options& options) {
    render::Environment environment{render::read_map(options.map), options.map_scale, 0.0f};
    environment.picture.channels.clear();
    return environment;
}

}  // namespace relight
