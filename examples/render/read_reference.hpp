#pragma once

#include <optional>

#include "io/picture.hpp"
#include "options.hpp"

namespace render {

/// The picture that `options.reference` names, if it names one. throws: invalid_input, also if it is not of
/// `options`' size.
std::optional<Picture> read_reference(const Options& options);

}  // namespace render
