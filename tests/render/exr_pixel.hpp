#pragma once

#include <string>

#include <glm/vec4.hpp>
#include <render/io/picture.hpp>

#include "support/temporary_folder.hpp"

/// An OpenEXR file of one pixel with alpha.
inline std::string exr_pixel(const glm::vec4& texel) {
    const TemporaryFolder folder;
    render::Picture picture(1, 1);
    picture.add_channel("A");
    picture.pixels[0] = glm::vec3(texel);
    picture.channels[0].values[0] = texel.a;
    render::write_exr(folder / "a.exr", picture);
    return folder.read("a.exr");
}
