#include "false_color.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <glm/common.hpp>

namespace render {

glm::vec3 false_color(double value, double white) {
    constexpr std::array<glm::vec3, 5> ramp = {glm::vec3(0.0f, 0.0f, 0.0f), glm::vec3(0.05f, 0.05f, 0.6f),
                                               glm::vec3(0.8f, 0.05f, 0.1f), glm::vec3(1.0f, 0.8f, 0.0f),
                                               glm::vec3(1.0f, 1.0f, 1.0f)};
    // The comparison is false for NaN, which must not become an index.
    const double share = value < white ? std::max(0.0, value / white) : 1.0;
    const double at = share * static_cast<double>(ramp.size() - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(at), ramp.size() - 2);
    return glm::mix(ramp[below], ramp[below + 1], static_cast<float>(at - static_cast<double>(below)));
}

LayerFigures figures_of(const std::vector<float>& layer) {
    LayerFigures figures;
    double sum = 0;
    std::size_t count = 0;
    for (const float v : layer) {
        if (!std::isfinite(v)) continue;
        const auto value = static_cast<double>(v);
        figures.min = count == 0 ? value : std::min(figures.min, value);
        figures.max = count == 0 ? value : std::max(figures.max, value);
        sum += value;
        ++count;
    }
    if (count > 0) figures.mean = sum / static_cast<double>(count);
    return figures;
}

}  // namespace render
