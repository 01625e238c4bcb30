#pragma once

#include <cstddef>
#include <map>
#include <vector>

#include <glm/mat4x4.hpp>

#include "io/gltf_document.hpp"
#include "io/gltf_mesh.hpp"
#include "io/gltf_nodes.hpp"

namespace render {

/// `primitive` with its morph targets added by `weights`; targets without a weight count for nothing.
GltfPrimitive morphed(const GltfPrimitive& primitive, const std::vector<double>& weights);

/// The skins of a glTF file.
class GltfSkins {
public:
    /// Both must outlive this object.
    GltfSkins(GltfDocument& document, const GltfNodes& nodes) : document_(document), nodes_(nodes) {}

    /// For each vertex of a primitive that skin `index` moves, its transform to the world: the mean of its joints' by
    /// weight. throws: invalid_input if the skin or a joint does not exist, or a vertex of a triangle has no weight at
    /// all.
    std::vector<glm::dmat4> to_world(std::size_t index, const GltfPrimitive& primitive);

private:
    const std::vector<glm::dmat4>& joints(std::size_t index);
    /// Of one vertex.
    glm::dmat4 blend(std::size_t index, const GltfPrimitive& primitive, std::size_t vertex,
                     const std::vector<glm::dmat4>& matrices) const;

    GltfDocument& document_;
    const GltfNodes& nodes_;
    std::map<std::size_t, std::vector<glm::dmat4>> joints_;  ///< by skin: from the mesh to the world
};

/// Where the instances of a node that has EXT_mesh_gpu_instancing stand, in the node's coordinates.
/// throws: invalid_input naming the node if their attributes differ in length or are not finite.
std::vector<glm::dmat4> instances_of(GltfDocument& document, const JsonObject& node);

}  // namespace render
