#pragma once

#include <glm/vec3.hpp>
#include <lightcuts/cut/lightcut.hpp>

#include "shader.hpp"

namespace render {

/// What a cut says of a surface point, or of a pixel.
inline Shading shading_of(const lightcuts::CutResult<glm::vec3>& cut) {
    Shading shading;
    shading.radiance = cut.radiance;
    shading.error_bound = cut.error_bound;
    shading.expected_error = cut.expected_error;
    shading.clamp_threshold = cut.clamp_threshold;
    shading.cut_size = cut.cut_size;
    shading.shadow_rays = cut.queries;
    shading.hidden = cut.hidden;
    shading.at_limit = cut.stop == lightcuts::StopReason::limit;
    return shading;
}

}  // namespace render
