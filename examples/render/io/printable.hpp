#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace render {

/// Text from a file as a message can quote it: in one line, what would control a terminal as `\x1b` and the like, cut
/// after `most` bytes.
std::string printable(std::string_view text, std::size_t most = 80);

}  // namespace render
