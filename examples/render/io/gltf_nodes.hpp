#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "io/gltf_animation.hpp"
#include "io/gltf_document.hpp"
#include "io/left_out.hpp"
#include "shutter.hpp"

namespace render {

/// The rotation of quaternion x, y, z, w of any length; none if that is 0.
glm::dmat3 rotation_of(const double* quaternion);

/// The nodes of a glTF file: a forest, of which the default scene shows some. Where the file has animations, nodes
/// stand as the first one has them as the shutter opens, and can be asked for while it is open.
class GltfNodes {
public:
    /// Where a node is.
    struct Pose {
        glm::dmat4 to_world{1.0};
        glm::dvec3 forward{0.0};
    };

    /// Names what is left out. throws: invalid_input if a node has two parents or is its own ancestor, if a transform
    /// has not as many numbers as it should, or if the scene or an animation refers to what is not there.
    GltfNodes(GltfDocument& document, const Shutter& shutter, LeftOutList& left_out);

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

    /// The node's pose and weights at a second of the animation. cost: that of its ancestors
    Pose pose(std::size_t node, double second) const;
    std::vector<double> weights(std::size_t node, double second) const;

    /// 0 if no animation moves the node; else into how many parts, at least, the time for which the shutter is open has
    /// to be divided so that the node turns by no more than half a turn in each.
    std::uint32_t least_parts(std::size_t node) const;

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
    void apply_animation();
    Parts parts_at(std::size_t node, double second) const;
    void compose();
    void find_shown();
    void note_other_scenes(LeftOutList& left_out) const;
    std::vector<std::size_t> roots() const;

    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

    GltfDocument& document_;
    Shutter shutter_;
    GltfAnimation animation_;
    std::vector<Parts> parts_;  ///< as the shutter opens
    std::vector<std::vector<std::size_t>> children_;
    std::vector<std::size_t> parent_;
    std::vector<std::vector<double>> weights_;
    std::vector<glm::dmat4> to_world_;
    std::vector<glm::dvec3> forward_;
    std::vector<std::size_t> shown_;
};

}  // namespace render
