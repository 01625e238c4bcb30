#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace render {

/// One statement of an OBJ or MTL file: its first word and the rest of its line.
struct ObjStatement {
    std::size_t line = 0;  ///< in which it begins, counted from 1
    std::string_view keyword;
    std::string_view rest;  ///< without blanks at its ends; comments are still in it
};

/// The statements of an OBJ or MTL file one after the other. Lines end with LF, CR LF or CR; a backslash at the end
/// of a line continues it; a line that begins with `#` is a comment, and so is an empty one. A byte order mark is
/// skipped.
class ObjLines {
public:
    /// `text` must outlive this object. throws: invalid_input naming `path` if it is UTF-16.
    ObjLines(const std::filesystem::path& path, std::string_view text);

    /// The next statement; false at the end. Its parts refer to the text, or to this object until the next call.
    bool next(ObjStatement& statement);

private:
    std::string_view take();

    std::string_view rest_;
    std::size_t line_ = 0;
    std::string joined_;  ///< a statement of several lines
};

/// The words of `text` up to the first that begins with `#`. Reuses `words`.
void split_before_comment(std::string_view text, std::vector<std::string_view>& words);

/// `text` without a comment: what stands before the first blank and `#`.
std::string_view without_comment(std::string_view text);

}  // namespace render
