#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "io/gltf_document.hpp"
#include "io/gltf_mesh.hpp"
#include "io/gltf_nodes.hpp"

namespace render {

/// `primitive` with its morph targets added by `weights`; targets without a weight count for nothing.
GltfPrimitive morphed(const GltfPrimitive& primitive, const std::vector<double>& weights);

/// A primitive's vertices in the world. Those without a normal or a tangent have zero ones.
struct PosedVertices {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents;
};

/// `to_world`: one transform of all vertices, or one of each.
PosedVertices posed_vertices(const GltfPrimitive& primitive, std::span<const glm::dmat4> to_world);

/// `v` with unit length, if it has any.
glm::vec3 unit_or_zero(const glm::dvec3& v);

/// The skins of a glTF file.
class GltfSkins {
public:
    /// Both must outlive this object.
    GltfSkins(GltfDocument& document, const GltfNodes& nodes) : document_(document), nodes_(nodes) {}

    /// For each vertex of a primitive that skin `index` moves, its transform to the world: the mean of its joints' by
    /// weight. throws: invalid_input if the skin or a joint does not exist, or a vertex of a triangle has no weight at
    /// all.
    std::vector<glm::dmat4> to_world(std::size_t index, const GltfPrimitive& primitive);

    /// The same at a second of the animation. pre: `to_world` of that skin and primitive does not throw.
    std::vector<glm::dmat4> to_world(std::size_t index, const GltfPrimitive& primitive, double second) const;

    /// As GltfNodes::least_parts, of all joints of a skin. pre: `to_world` of that skin does not throw.
    std::uint32_t least_parts(std::size_t index) const;

private:
    struct Skin {
        std::vector<std::size_t> joints;
        std::vector<glm::dmat4> inverse;   ///< from the mesh to each joint
        std::vector<glm::dmat4> to_world;  ///< from the mesh to the world, as the shutter opens
    };

    const Skin& skin(std::size_t index);
    std::vector<glm::dmat4> blended(std::size_t index, const GltfPrimitive& primitive,
                                    const std::vector<glm::dmat4>& matrices) const;
    /// Of one vertex.
    glm::dmat4 blend(std::size_t index, const GltfPrimitive& primitive, std::size_t vertex,
                     const std::vector<glm::dmat4>& matrices) const;

    GltfDocument& document_;
    const GltfNodes& nodes_;
    std::map<std::size_t, Skin> skins_;
};

/// Where the instances of a node that has EXT_mesh_gpu_instancing stand, in the node's coordinates.
/// throws: invalid_input naming the node if their attributes differ in length or are not finite.
std::vector<glm::dmat4> instances_of(GltfDocument& document, const JsonObject& node);

}  // namespace render
