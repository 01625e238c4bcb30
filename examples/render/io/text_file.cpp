#include "io/text_file.hpp"

#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <lightcuts/core/invalid_input.hpp>

#include "io/descriptor.hpp"

namespace render {
namespace {

constexpr std::size_t block = std::size_t{1} << 20;
/// A pipe may never end. A file has a size, which memory has to hold.
constexpr std::size_t largest_pipe = std::size_t{1} << 30;

}  // namespace

std::string read_file(const std::filesystem::path& path) {
    const auto refuse = [&](const std::string& problem) {
        throw lightcuts::invalid_input(path.string() + ": " + problem);
    };
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    struct stat status {};
    if (!file) {
        if (errno == ENOENT || errno == ENOTDIR) refuse("there is no such file; check the path");
        refuse(std::string("cannot be read (") + std::strerror(errno) + "); name a readable file");
    }
    if (::fstat(file.number(), &status) != 0 || S_ISDIR(status.st_mode)) refuse("cannot be read; name a readable file");
    const bool is_pipe = S_ISFIFO(status.st_mode);
    if (!S_ISREG(status.st_mode) && !is_pipe) refuse("is a device, not a file; name a readable file");
    std::string text;
    try {
        if (!is_pipe) text.reserve(static_cast<std::size_t>(status.st_size) + 1);
        for (std::size_t size = 0;;) {
            text.resize(is_pipe || size + 1 > text.capacity() ? size + block : text.capacity());
            const ::ssize_t count = ::read(file.number(), text.data() + size, text.size() - size);
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) refuse(std::string("reading failed (") + std::strerror(errno) + "); check the disk");
            size += static_cast<std::size_t>(count);
            text.resize(size);
            if (count == 0) return text;
            if (is_pipe && size > largest_pipe) refuse("more than a gigabyte came from this pipe; name a file");
        }
    } catch (const std::bad_alloc&) { refuse("is larger than memory; name a smaller file"); }
    return text;
}

void fail_at(const std::filesystem::path& path, std::size_t line, const std::string& text) {
    throw lightcuts::invalid_input(path.string() + ":" + std::to_string(line) + ": " + text);
}

std::optional<double> parse_number(std::string_view text) {
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (end != text.data() + text.size() || text.empty()) return std::nullopt;
    if (error == std::errc{}) return value;
    // What is too small for a double is 0.
    if (error == std::errc::result_out_of_range) return std::strtod(std::string(text).c_str(), nullptr);
    return std::nullopt;
}

std::string_view trim(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::string in_lower_case(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return result;
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

std::string_view take_line(std::string_view& rest) {
    const std::size_t end = rest.find_first_of("\n\r");
    const std::string_view line = rest.substr(0, end);
    if (end == std::string_view::npos) {
        rest = {};
    } else {
        rest.remove_prefix(end + (rest.substr(end).starts_with("\r\n") ? 2 : 1));
    }
    return line;
}

}  // namespace render
