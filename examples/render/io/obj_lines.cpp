#include "io/obj_lines.hpp"

#include <lightcuts/core/invalid_input.hpp>

#include "io/text_file.hpp"

namespace render {
namespace {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

}  // namespace

ObjLines::ObjLines(const std::filesystem::path& path, std::string_view text) : rest_(text) {
    const bool is_utf16 = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
    if (is_utf16) throw lightcuts::invalid_input(path.string() + ": is UTF-16 text; save it as UTF-8");
    if (rest_.starts_with(byte_order_mark)) rest_.remove_prefix(byte_order_mark.size());
}

std::string_view ObjLines::take() {
    ++line_;
    return trimmed(take_line(rest_));
}

bool ObjLines::next(ObjStatement& statement) {
    while (!rest_.empty()) {
        std::string_view line = take();
        if (line.empty() || line.front() == '#') continue;
        statement.line = line_;
        if (line.back() == '\\' && !rest_.empty()) {
            joined_.clear();
            while (!line.empty() && line.back() == '\\') {
                joined_ += line.substr(0, line.size() - 1);
                joined_ += ' ';
                line = rest_.empty() ? std::string_view() : take();
            }
            joined_ += line;
            line = trimmed(joined_);
            if (line.empty()) continue;
        }
        std::size_t end = 0;
        while (end < line.size() && !is_blank(line[end])) ++end;
        statement.keyword = line.substr(0, end);
        statement.rest = trimmed(line.substr(end));
        return true;
    }
    return false;
}

void split_before_comment(std::string_view text, std::vector<std::string_view>& words) {
    words.clear();
    std::size_t at = 0;
    while (true) {
        while (at < text.size() && is_blank(text[at])) ++at;
        if (at == text.size() || text[at] == '#') return;
        const std::size_t begin = at;
        while (at < text.size() && !is_blank(text[at])) ++at;
        words.push_back(text.substr(begin, at - begin));
    }
}

std::string_view without_comment(std::string_view text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '#' && (i == 0 || is_blank(text[i - 1]))) return trimmed(text.substr(0, i));
    }
    return text;
}

}  // namespace render
