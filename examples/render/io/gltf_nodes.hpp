#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "io/gltf_document.hpp"
#include "io/left_out.hpp"

namespace render {

/// The rotation of quaternion x, y, z, w of any length; none if that is 0.
glm::dmat3 rotation_of(const double* quaternion);

/// The nodes of a glTF file: a forest, of which the default scene shows some. Where the file has animations, nodes
/// stand as the first one begins.
class GltfNodes {
public:
    /// Names what is left out. throws: invalid_input if a node has two parents or is its own ancestor, if a transform
    /// has not as many numbers as it should, or if the scene or an animation refers to what is not there.
    GltfNodes(GltfDocument& document, LeftOutList& left_out);

    /// Those that are shown, parents before their children.
    const std::vector<std::size_t>& shown() const { return shown_; }

    JsonObject json(std::size_t node) const { return document_.element("nodes", node, "node"); }
    std::size_t count() const { return parts_.size(); }

    /// From the node's own coordinates to those of the world.
    const glm::dmat4& to_world(std::size_t node) const { return to_world_[node]; }

    /// Unit, or zero if a scale of zero leaves none: where a camera or light of the node looks, its -z. Scales have no
    /// effect on it.
    glm::dvec3 forward(std::size_t node) const { return forward_[node]; }

    /// Of the morph targets of the node's mesh, where an animation or the node sets them; else empty.
    const std::vector<double>& weights(std::size_t node) const { return weights_[node]; }

private:
    /// A node's transform to its parent.
    struct Parts {
        glm::dmat4 matrix{1.0};
        glm::dvec3 translation{0.0};
        glm::dmat3 rotation{1.0};
        glm::dvec3 scale{1.0};
        bool is_matrix = false;

        glm::dmat4 to_parent() const;
        glm::dmat3 turn() const;  ///< the same without scales
    };

    void read_parts();
    void read_parents();
    void apply_animation(LeftOutList& left_out);
    void apply_channel(const JsonObject& animation, const JsonObject& channel, LeftOutList& left_out);
    void compose();
    void find_shown();
    void note_other_scenes(LeftOutList& left_out) const;
    std::vector<std::size_t> roots() const;

    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

    GltfDocument& document_;
    std::vector<Parts> parts_;
    std::vector<std::vector<std::size_t>> children_;
    std::vector<std::size_t> parent_;
    std::vector<std::vector<double>> weights_;
    std::vector<glm::dmat4> to_world_;
    std::vector<glm::dvec3> forward_;
    std::vector<std::size_t> shown_;
};

}  // namespace render
