#pragma once

#include <lightcuts/visibility/occluder_mesh.hpp>

#include "scene.hpp"

namespace render {

/// What hides lights for certain. Triangles have their numbers in the scene; those that let light pass or move are
/// drawn together to a point, and hide nothing.
lightcuts::OccluderMesh opaque_mesh(const Scene& scene);

}  // namespace render
