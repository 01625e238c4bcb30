#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace render {

/// `text` with each %XX replaced by the byte that it stands for; a plus sign stays one [RFC 3986].
std::string percent_decoded(std::string_view text);

/// The bytes of a URI that begins with `data:`; empty if its base64 is damaged.
std::optional<std::string> data_of_uri(std::string_view uri);

inline bool is_data_uri(std::string_view uri) { return uri.starts_with("data:"); }

}  // namespace render
