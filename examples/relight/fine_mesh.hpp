#pragma once

#include <render/scene.hpp>

namespace relight {

/// Splits edges of `scene` in the middle until none is longer than `longest_edge`, and triangles with them, so that
/// what is known at vertices only is known everywhere within that distance. Edges of two triangles are split alike:
/// the mesh stays as closed as it was. The surface does not change, nor do materials.
/// pre: nothing moves; longest_edge > 0. throws: invalid_input if there would be more than `most_triangles`.
void refine_mesh(render::Scene& scene, double longest_edge, std::size_t most_triangles = std::size_t{1} << 22);

}  // namespace relight
