#pragma once

#include <vector>

#include <tiny_gltf.h>

namespace render {

/// All numbers of accessor `index`, one element after the other; normalised integers are in [0, 1] or [-1, 1].
/// throws: invalid_input when it does not exist, has not `components` numbers an element, or reaches past its buffer.
std::vector<double> read_accessor(const tinygltf::Model& model, int index, int components);

}  // namespace render
