#include "io/escape.hpp"

#include <cstdint>

namespace render {

namespace {

/// Bytes of the UTF-8 character that `text` begins with; 0 if it begins with none. pre: not empty.
std::size_t character_length(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
    const std::uint8_t first = byte(0);
    if (first < 0x80) return 1;
    const std::size_t length = first >= 0xc2 && first < 0xe0   ? 2
                               : first >= 0xe0 && first < 0xf0 ? 3
                               : first >= 0xf0 && first < 0xf5 ? 4
                                                               : 0;
    if (length == 0 || text.size() < length) return 0;
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xc0) != 0x80) return 0;
    }
    // Longer than needed, halves of a pair of UTF-16, beyond the last character.
    const std::uint8_t second = byte(1);
    if ((first == 0xe0 && second < 0xa0) || (first == 0xed && second >= 0xa0)) return 0;
    if ((first == 0xf0 && second < 0x90) || (first == 0xf4 && second >= 0x90)) return 0;
    return length;
}

bool is_control(std::string_view character) {
    const auto first = static_cast<std::uint8_t>(character[0]);
    if (character.size() == 1) return first < 0x20 || first == 0x7f;
    // U+0080 to U+009F, some of which begin a terminal's commands.
    return first == 0xc2 && static_cast<std::uint8_t>(character[1]) < 0xa0;
}

void append_escaped(std::string& to, std::string_view bytes) {
    constexpr char digits[] = "0123456789ABCDEF";
    if (bytes == "\n" || bytes == "\r" || bytes == "\t") {
        to += bytes == "\n" ? "\\n" : bytes == "\r" ? "\\r" : "\\t";
        return;
    }
    for (const char c : bytes) {
        const auto value = static_cast<std::uint8_t>(c);
        to += "\\x";
        to += digits[value >> 4];
        to += digits[value & 15];
    }
}

template <class IsEscaped>
std::string with_escapes(std::string_view text, IsEscaped&& is_escaped) {
    std::string result;
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        const std::string_view character = text.substr(0, length == 0 ? 1 : length);
        if (length == 0 || is_escaped(character)) {
            append_escaped(result, character);
        } else {
            result += character;
        }
        text.remove_prefix(character.size());
    }
    return result;
}

}  // namespace

std::string as_utf8(std::string_view text) {
    return with_escapes(text, [](std::string_view) { return false; });
}

std::string escaped(std::string_view text) { return with_escapes(text, is_control); }

std::string excerpt(std::string_view text, std::size_t most) {
    return text.size() > most ? escaped(text.substr(0, most)) + "..." : escaped(text);
}

std::string one_line(std::string_view text) {
    std::string line;
    for (const char c : text) {
        const bool space = c == '\n' || c == '\r' || c == '\t' || c == ' ';
        if (!space) {
            line += c;
        } else if (!line.empty() && line.back() != ' ') {
            line += ' ';
        }
    }
    while (!line.empty() && line.back() == ' ') line.pop_back();
    return line;
}

}  // namespace render
