#pragma once

#include <string>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "io/left_out.hpp"
#include "scene.hpp"

namespace render {

/// True iff no channel of `color` is above 1: a surface reflects no more than it gets.
bool is_reflectance(const glm::vec3& color);

/// Cuts off what `color`, a share of light that a surface reflects or lets pass, has above 1, and names it as
/// "what is above 1 of NAME".
void clip_reflectance(glm::vec3& color, const std::string& name, LeftOutList& left_out);

/// Likewise of vertex colors, whose alpha is cut off too.
void clip_reflectance(std::vector<glm::vec4>& colors, LeftOutList& left_out);

/// Likewise of all texels of a texture that says anything but what a surface emits.
void clip_reflectance(Texture& texture, LeftOutList& left_out);

}  // namespace render
