#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "io/gltf_document.hpp"
#include "io/gltf_materials.hpp"
#include "io/left_out.hpp"

namespace render {

/// Differences that a morph target of weight 1 adds; empty, or per vertex.
struct GltfMorph {
    std::vector<glm::dvec3> positions;
    std::vector<glm::dvec3> normals;
    std::vector<glm::dvec3> tangents;
    std::vector<glm::dvec4> colors;
};

/// Of a skinned vertex: four joints and their shares.
struct GltfBones {
    std::array<double, 4> joints{};  ///< as the file says, whether they exist or not
    std::array<double, 4> weights{};
};

/// Triangles of one material in the coordinates of their mesh. Lists but positions are empty, or per vertex.
struct GltfPrimitive {
    std::string name;            ///< in messages
    std::uint32_t material = 0;  ///< in the scene
    std::vector<glm::dvec3> positions;
    std::vector<glm::dvec3> normals;
    std::vector<glm::dvec4> tangents;  ///< only of materials with a normal map
    std::vector<glm::dvec4> colors;
    std::map<std::size_t, std::vector<glm::vec2>> uvs;  ///< by the n of TEXCOORD_n; those that the material uses
    std::vector<std::vector<GltfBones>> bones;          ///< four joints a set
    std::string bones_problem;                          ///< why `bones` cannot be used; empty: they can
    std::vector<GltfMorph> morphs;
    std::vector<glm::uvec3> triangles;
};

/// A mesh as the file stores it.
struct GltfMesh {
    std::vector<GltfPrimitive> primitives;
    std::vector<double> weights;  ///< of its morph targets, where the node sets none
};

/// Reads meshes, each once.
class GltfMeshes {
public:
    /// All must outlive this object.
    GltfMeshes(GltfDocument& document, GltfMaterials& materials, Scene& scene)
        : document_(document), materials_(materials), scene_(scene) {}

    /// throws: invalid_input naming the mesh, its primitive and what is wrong with it.
    const GltfMesh& mesh(std::size_t index);

private:
    GltfMesh read(std::size_t index);
    void read_primitive(const JsonObject& source, GltfPrimitive& primitive);
    void read_uvs(const JsonObject& attributes, GltfPrimitive& primitive);
    void read_bones(const JsonObject& attributes, GltfPrimitive& primitive);
    void read_bones(const JsonObject& attributes, std::size_t set, GltfPrimitive& primitive);
    void read_morphs(const JsonObject& source, GltfPrimitive& primitive);
    void read_triangles(const JsonObject& source, GltfPrimitive& primitive);
    std::vector<double> attribute(const JsonObject& attributes, const char* name, std::size_t components,
                                  std::size_t count) const;
    std::vector<glm::dvec4> colors(const JsonObject& attributes, std::size_t count, double alpha) const;

    GltfDocument& document_;
    GltfMaterials& materials_;
    Scene& scene_;
    std::map<std::size_t, GltfMesh> meshes_;
};

}  // namespace render
