#include "text_file.hpp"

#include <charconv>
#include <fstream>
#include <iterator>

#include <lightcuts/core/invalid_input.hpp>

namespace render {

std::string read_file(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) {
        throw lightcuts::invalid_input(path.string() + ": there is no such file; check the path");
    }
    std::ifstream file(path, std::ios::binary);
    if (std::filesystem::is_directory(path, error) || !file) {
        throw lightcuts::invalid_input(path.string() + ": cannot be read; name a readable file");
    }
    std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    if (file.bad()) throw lightcuts::invalid_input(path.string() + ": reading failed; check the disk or the network");
    return text;
}

void fail_at(const std::filesystem::path& path, std::size_t line, const std::string& text) {
    throw lightcuts::invalid_input(path.string() + ":" + std::to_string(line) + ": " + text);
}

std::optional<double> parse_number(std::string_view text) {
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

std::string_view trim(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::vector<std::string_view> split_words(std::string_view text) {
    std::vector<std::string_view> words;
    for (text = trim(text); !text.empty(); text = trim(text)) {
        const std::size_t end = text.find_first_of(" \t\r");
        words.push_back(text.substr(0, end));
        text.remove_prefix(end == std::string_view::npos ? text.size() : end);
    }
    return words;
}

}  // namespace render
