#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "io/gltf_document.hpp"
#include "io/left_out.hpp"
#include "shutter.hpp"

namespace render {

/// What an animation says of one property of a node.
class GltfChannel {
public:
    enum class Property { translation, rotation, scale, weights };
    enum class Interpolation { step, linear, cubic };

    std::size_t node = 0;
    Property property = Property::translation;
    Interpolation interpolation = Interpolation::linear;
    std::size_t size = 3;        ///< numbers of a value
    std::vector<double> times;   ///< of the keys, ascending; seconds
    std::vector<double> values;  ///< `size` numbers a key; cubic: incoming tangent, value, outgoing tangent

    /// The value at `second`; that of the first or the last key before and after all keys. Rotations turn the shorter
    /// way round, evenly, and are quaternions of unit length unless a key's own is not.
    std::vector<double> at(double second) const;

private:
    std::vector<double> key(std::size_t index) const;
    std::vector<double> cubic_between(std::size_t index, double share) const;
};

/// The first animation of a glTF file, while a shutter is open.
class GltfAnimation {
public:
    /// Names what is left out. Keys after the shutter's closing are not looked at but for the next one.
    /// throws: invalid_input if a channel refers to what is not there, has not one value for each key, or its keys are
    /// not in order.
    GltfAnimation(GltfDocument& document, const Shutter& shutter, LeftOutList& left_out);

    /// The channels of a node, as the file orders them.
    const std::vector<GltfChannel>& channels(std::size_t node) const;

    /// Keys of a node's channels while the shutter is open, at most, and one more where there are channels: between two
    /// nothing turns by more than half a turn.
    std::uint32_t least_parts(std::size_t node) const;

private:
    void read_channel(const JsonObject& animation, const JsonObject& channel, LeftOutList& left_out);

    GltfDocument& document_;
    Shutter shutter_;
    std::map<std::size_t, std::vector<GltfChannel>> channels_;
};

}  // namespace render
