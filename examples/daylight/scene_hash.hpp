#pragma once

#include <cstdint>

#include <render/scene.hpp>

namespace daylighting {

/// A hash of all that shadow rays in a scene depend on, by which it is told from others.
std::uint64_t scene_hash(const render::Scene& scene);

}  // namespace daylighting
