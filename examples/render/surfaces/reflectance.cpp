#include "surfaces/reflectance.hpp"

#include <cstddef>
#include <optional>

#include <glm/common.hpp>

namespace render {
namespace {

void name_excess(const std::string& name, LeftOutList& left_out) {
    leave_out(left_out, "what is above 1 of " + name, "a surface reflects no more than it gets");
}

/// The place of the first that had something above 1, if one did.
std::optional<std::size_t> clip(std::vector<glm::vec4>& values) {
    std::optional<std::size_t> first;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const glm::vec4 clipped = glm::min(values[i], glm::vec4(1.0f));
        if (clipped == values[i]) continue;
        values[i] = clipped;
        if (!first) first = i;
    }
    return first;
}

}  // namespace

bool is_reflectance(const glm::vec3& color) { return glm::min(color, glm::vec3(1.0f)) == color; }

void clip_reflectance(glm::vec3& color, const std::string& name, LeftOutList& left_out) {
    if (is_reflectance(color)) return;
    color = glm::min(color, glm::vec3(1.0f));
    name_excess(name, left_out);
}

void clip_reflectance(std::vector<glm::vec4>& colors, LeftOutList& left_out) {
    if (const auto first = clip(colors)) {
        name_excess("vertex colors, such as that of vertex " + std::to_string(*first), left_out);
    }
}

void clip_reflectance(Texture& texture, LeftOutList& left_out) {
    if (clip(texture.texels)) name_excess("the texture '" + texture.name + "'", left_out);
}

}  // namespace render
