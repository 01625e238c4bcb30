#pragma once

#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "scene.hpp"

namespace render {

/// The least and the most of each channel.
struct TexelRange {
    glm::vec4 low{1.0f};
    glm::vec4 high{1.0f};
};

/// What a texture may give within boxes of uv, from the least and the most of blocks of its texels, blocks of blocks
/// and so on. memory: an eighth of the texture's. cost: O(texels) to make, O(1) a box.
class TextureRange {
public:
    /// `texture` must outlive this object.
    explicit TextureRange(const Texture& texture);

    /// Bounds of `Texture::sample` for every uv in the box from `low` to `high`; within one cell of texels, exact.
    TexelRange over(const glm::dvec2& low, const glm::dvec2& high) const;

    TexelRange over_all() const;

    /// How many texels a step of 1 in u and v passes.
    glm::dvec2 size() const { return {texture_->width, texture_->height}; }

private:
    struct Level {
        int width = 0;
        int height = 0;
        std::vector<TexelRange> blocks;
    };
    struct Interval {
        int first = 0;
        int last = 0;
    };
    struct Axis;

    void add_texels(const Interval& columns, const Interval& rows, TexelRange& range) const;
    TexelRange in_cell(const Axis& x, const Axis& y) const;

    const Texture* texture_;
    std::vector<Level> levels_;  ///< from blocks of `block` x `block` texels to one block
};

}  // namespace render
