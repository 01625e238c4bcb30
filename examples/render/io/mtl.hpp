#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "io/left_out.hpp"

namespace render {

/// A texture as an MTL file names it, with its options.
struct MtlMap {
    std::string file;  ///< as it is written
    std::size_t line = 0;
    glm::dvec2 offset{0.0};  ///< -o: added to uv after scaling
    glm::dvec2 scale{1.0};   ///< -s: of uv
    double base = 0.0;       ///< -mm: value = base + gain x texel
    double gain = 1.0;
    bool clamp = false;   ///< -clamp on: what lies outside [0, 1] takes the color of the edge
    char channel = '\0';  ///< -imfchan r, g, b, m (matte), l (luminance) or z; 0: not given
};

/// A keyword that is unknown.
struct MtlUnknown {
    std::string keyword;  ///< as it is written
    std::size_t line = 0;
};

/// A material as an MTL file states it; what is not there is empty.
struct MtlMaterial {
    std::string name;
    std::size_t line = 0;
    std::optional<glm::vec3> diffuse;    ///< Kd, each at most 1, as the others that reflect
    std::optional<glm::vec3> specular;   ///< Ks
    std::optional<glm::vec3> emission;   ///< Ke
    std::optional<glm::vec3> filter;     ///< Tf
    std::optional<float> exponent;       ///< Ns
    std::optional<float> ior;            ///< Ni
    std::optional<float> dissolve;       ///< d
    std::optional<float> transparency;   ///< Tr
    std::optional<int> illumination;     ///< illum
    std::optional<MtlMap> diffuse_map;   ///< map_Kd
    std::optional<MtlMap> specular_map;  ///< map_Ks
    std::optional<MtlMap> emission_map;  ///< map_Ke
    std::optional<MtlMap> dissolve_map;  ///< map_d
    std::optional<MtlMap> normal_map;    ///< norm
    LeftOutList left_out;
    std::vector<MtlUnknown> unknown;  ///< each keyword once
    /// What makes the material unusable, with file and line; empty: nothing. What follows it is not read.
    std::string problem;
};

/// What an MTL file says. Every number is finite.
struct MtlLibrary {
    std::filesystem::path path;
    std::vector<MtlMaterial> materials;
};

/// Reads an MTL file. Keywords may be in upper or lower case; a color may be one number, for all three, or `xyz` and
/// CIE coordinates. A number that is none, not finite or negative, a color of two numbers, and a spectral file are
/// problems of their material. throws: invalid_input if it is UTF-16.
MtlLibrary parse_mtl(const std::filesystem::path& path, std::string_view text);

}  // namespace render
