#pragma once

#include <string>

#include <render/scene.hpp>

#include "site.hpp"

namespace relight {

/// A scene whose mesh is as fine as visibility is stored, with the sites of it.
struct Mesh {
    render::Scene scene;
    Sites sites;
};

/// Reads a scene that does not move. throws: invalid_input.
render::Scene load_still_scene(const std::string& name);

/// Refines the mesh of `scene` and finds its sites.
Mesh refined(render::Scene scene, double longest_edge);

}  // namespace relight
