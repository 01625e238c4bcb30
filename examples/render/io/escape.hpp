#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace render {

/// `text` with each byte that is no part of a UTF-8 character written as `\xE9`: names of files may be any bytes, JSON
/// may not.
std::string as_utf8(std::string_view text);

/// The same with control characters written as `\n` or `\x1B`: one line that does nothing to a terminal.
std::string escaped(std::string_view text);

/// The same of what stands in a file, as a message can quote it: cut after `most` bytes.
std::string excerpt(std::string_view text, std::size_t most = 80);

/// The words of `text`, one space between any two: a message of one line made of one that may have several.
std::string one_line(std::string_view text);

}  // namespace render
