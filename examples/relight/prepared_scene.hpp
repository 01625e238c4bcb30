#pragma once

#include <filesystem>
#include <vector>

#include <render/lights/background.hpp>
#include <render/rays/ray_scene.hpp>
#include <render/rays/ray_tracer.hpp>
#include <render/scene.hpp>

#include "mesh.hpp"
#include "options.hpp"
#include "relight_file.hpp"

namespace relight {

/// A scene with the cuts that were prepared of it.
struct PreparedScene {
    /// Refines the mesh of `scene` as the file asks, and puts it into the ray tracer. throws: invalid_input for a file
    /// that cannot be read or is of another mesh.
    PreparedScene(const std::filesystem::path& cut_file, render::Scene scene, const render::RayTracer& tracer);

    const RelightFile file;
    const Mesh mesh;
    const render::RayScene rays;
};

/// The files that pictures of `scene` are made of.
std::vector<std::filesystem::path> inputs_of(const Options& options, const render::Scene& scene);

/// Reads the map that `options` name. throws: invalid_input.
render::Environment read_environment(const Options& options);

}  // namespace relight
