#pragma once

#include <cstdint>

namespace lightcuts {

/// One node of a cut: which one, and how many leaves of the tree do not lie to the right of it. The leaves below the
/// node are those from the `leaf_end` of the piece before to its own. 8 bytes.
///
/// Leaves are counted from left to right instead of storing the node's first leaf, so that the size of a piece takes
/// one subtraction in a tree of any shape. Both numbers are one word: of two pieces that share a leaf, the one of the
/// smaller word lies within the other, or is the same [Cut merging 2008, section 3.2, properties of a post-order].
class Piece {
public:
    constexpr Piece() = default;
    constexpr Piece(std::uint32_t node, std::uint32_t leaf_end) : key_(std::uint64_t{leaf_end} << 32 | node) {}

    constexpr std::uint32_t node() const { return static_cast<std::uint32_t>(key_); }
    /// Number of leaves below this node and to the left of it.
    constexpr std::uint32_t leaf_end() const { return static_cast<std::uint32_t>(key_ >> 32); }
    /// `leaf_end` in the upper half, `node` in the lower.
    constexpr std::uint64_t key() const { return key_; }

    friend constexpr bool operator==(const Piece&, const Piece&) = default;

private:
    std::uint64_t key_ = 0;
};
static_assert(sizeof(Piece) == 8);

}  // namespace lightcuts
