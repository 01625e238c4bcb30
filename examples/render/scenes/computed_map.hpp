#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <lightcuts/source/environment.hpp>

#include "io/picture.hpp"

namespace render {

/// A latitude-longitude map of `height` rows, twice as wide, of what `radiance(direction)` is: the mean of four points
/// a pixel, so that edges are not ragged.
template <class Radiance>
Picture computed_map(int height, const Radiance& radiance) {
    const int width = 2 * height;
    Picture map(width, height);
    const lightcuts::EnvironmentMap places(static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height),
                                           [](std::uint32_t, std::uint32_t) { return 1.0f; });
    constexpr std::array offsets{glm::dvec2(0.25, 0.25), glm::dvec2(0.75, 0.25), glm::dvec2(0.25, 0.75),
                                 glm::dvec2(0.75, 0.75)};
    const auto columns = static_cast<std::size_t>(width);
    for (std::size_t i = 0; i < map.size(); ++i) {
        const glm::dvec2 corner(i % columns, i / columns);
        for (const glm::dvec2& offset : offsets) {
            map.pixels[i] += 0.25f * radiance(glm::vec3(places.direction_at(corner + offset)));
        }
    }
    return map;
}

}  // namespace render
