#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "io/left_out.hpp"

namespace render {

/// One vertex of a face: indices from 0; `none` where the face names no such thing.
struct ObjCorner {
    static constexpr std::int32_t none = -1;

    std::int32_t position = none;
    std::int32_t uv = none;
    std::int32_t normal = none;
};

/// A polygon: `count` >= 3 corners from `first` on.
struct ObjFace {
    std::size_t first = 0;
    std::uint32_t count = 0;
    std::int32_t material = -1;  ///< in ObjGeometry::materials; -1 before the first `usemtl`
};

/// A name that a line of the file mentions.
struct ObjName {
    std::string name;
    std::size_t line = 0;  ///< the first that does
};

/// What an OBJ file says. Every index is within its list and every number is finite.
struct ObjGeometry {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> colors;  ///< of positions, linear; empty if no vertex has one
    std::vector<glm::dvec2> uvs;    ///< v upwards
    std::vector<glm::vec3> normals;
    std::vector<ObjCorner> corners;
    std::vector<ObjFace> faces;
    std::vector<ObjName> materials;    ///< of `usemtl`, each name once
    std::vector<ObjName> libraries;    ///< what stands behind `mtllib`, a line each
    std::size_t first_short_face = 0;  ///< line of the first face of less than three vertices, which are left out
    LeftOutList left_out;
};

/// Reads an OBJ file. Names stand as in the file, with comments and quotes. `path` is for messages.
/// throws: invalid_input with file and line for a number that is none or not finite, an index without an element, or a
/// face whose vertices are not written alike.
ObjGeometry parse_obj(const std::filesystem::path& path, std::string_view text);

}  // namespace render
