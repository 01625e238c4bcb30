#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace render {

/// With which some programs begin a text in UTF-8.
inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// The whole file, or up to a gigabyte of a pipe. throws: invalid_input when it is missing, a directory, a device,
/// unreadable, or larger than memory.
std::string read_file(const std::filesystem::path& path);

/// Throws invalid_input with "file:line: text".
[[noreturn]] void fail_at(const std::filesystem::path& path, std::size_t line, const std::string& text);

/// `text` as a number, if all of it is one. "nan" and "inf" are numbers; a leading plus sign is allowed.
std::optional<double> parse_number(std::string_view text);

/// `text` without spaces, tabs and carriage returns at its ends.
std::string_view trim(std::string_view text);

/// `text` with A to Z made small.
std::string in_lower_case(std::string_view text);

/// The parts of `text` between spaces and tabs.
std::vector<std::string_view> split_words(std::string_view text);

/// Takes the first line off `rest`, without its end: LF, CR LF or CR.
std::string_view take_line(std::string_view& rest);

/// Calls `visit(line number from 1, line)` for each line.
template <class Visit>
void for_each_line(std::string_view text, Visit&& visit) {
    for (std::size_t line = 1; !text.empty(); ++line) {
        const std::string_view content = take_line(text);
        visit(line, content);
    }
}

}  // namespace render
