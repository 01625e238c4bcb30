#include "mesh.hpp"

#include <utility>

#include <render/io/load_scene.hpp>

#include "fine_mesh.hpp"

namespace relight {

render::Scene load_still_scene(const std::string& name) {
    render::Scene scene = render::load_scene(name);
    // What surrounds it is what pictures are made under, and nothing else.
    scene.background = {};
    return scene;
}

Mesh refined(render::Scene scene, double longest_edge) {
    Mesh mesh{std::move(scene), {}};
    if (longest_edge > 0.0) refine_mesh(mesh.scene, longest_edge);
    mesh.sites = sites_of(mesh.scene);
    return mesh;
}

}  // namespace relight
