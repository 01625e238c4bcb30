#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace render {

/// Text from a file as a message can quote it: in one line, what is not printable ASCII as question marks, cut after
/// `most` characters.
std::string printable(std::string_view text, std::size_t most = 60);

}  // namespace render
