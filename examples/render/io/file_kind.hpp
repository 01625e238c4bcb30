#pragma once

#include <string>
#include <string_view>

namespace render {

/// Whether a file of these bytes is a Radiance picture by its first two, `#?`.
bool begins_as_radiance(std::string_view bytes);

/// Whether a file of these bytes is an OpenEXR picture by its first four.
bool begins_as_openexr(std::string_view bytes);

/// What a file of these bytes is by its first ones, whatever its name says: "a WebP picture". Empty if unknown.
std::string_view file_kind(std::string_view bytes);

/// The same as a clause for messages: "it is a WebP picture", "it is empty", or `otherwise` if unknown.
std::string what_it_is(std::string_view bytes, const std::string& otherwise);

}  // namespace render
