#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "io/gltf_document.hpp"

namespace render {

/// The numbers of the first `most` elements of accessor `index`, one element after the other; normalized integers are
/// in [0, 1] or [-1, 1]. One without a bufferView is zeros; sparse values are put in. Messages call an element
/// `element`. throws: invalid_input when it does not exist, has not `components` numbers an element, reaches past its
/// data, or when one of these numbers is not finite.
std::vector<double> read_accessor(GltfDocument& document, std::size_t index, std::size_t components,
                                  std::size_t most = std::numeric_limits<std::size_t>::max(),
                                  const char* element = "element");

/// How many numbers its elements have. throws: invalid_input if its type is unknown.
std::size_t components_of(const GltfDocument& document, std::size_t accessor);

/// True iff the file holds values of accessor `index` other than the zeros that it begins with.
bool has_data(const GltfDocument& document, std::size_t index);

}  // namespace render
