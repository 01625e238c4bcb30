#include "io/radiance_header.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/escape.hpp"
#include "io/file_kind.hpp"
#include "io/picture_size.hpp"
#include "io/text_file.hpp"

namespace render {

namespace {

/// The lines of a header, one after the other.
class Lines {
public:
    explicit Lines(std::string_view bytes) : bytes_(bytes) {}

    /// The next line without its end.
    std::string_view next() {
        const std::size_t end = bytes_.find('\n', at_);
        if (end == std::string_view::npos) throw std::runtime_error("it is cut short in its header");
        const std::string_view line = bytes_.substr(at_, end - at_);
        if (line.ends_with('\r')) {
            throw std::runtime_error(
                "the lines of its header end as in a text file of Windows: it was transferred as text, which damages "
                "pixels; transfer it as binary");
        }
        at_ = end + 1;
        return line;
    }
    std::size_t at() const { return at_; }

private:
    std::string_view bytes_;
    std::size_t at_ = 0;
};

[[noreturn]] void refuse_line(std::string_view line, const std::string& because) {
    throw std::runtime_error("'" + excerpt(line) + "' " + because);
}

/// The numbers after `NAME=`.
std::vector<double> numbers_of(std::string_view line, std::string_view value, std::size_t count) {
    std::vector<double> numbers;
    for (const std::string_view word : split_words(value)) {
        const auto number = parse_number(word);
        if (!number || !std::isfinite(*number)) refuse_line(line, "has something else than numbers");
        numbers.push_back(*number);
    }
    if (numbers.size() != count) refuse_line(line, "needs " + std::to_string(count) + " numbers");
    return numbers;
}

/// Takes up that the picture was multiplied by `factor`.
void multiply_exposure(RadianceHeader& header, std::string_view line, const glm::dvec3& factor) {
    header.exposure *= factor;
    for (int c = 0; c < 3; ++c) {
        // What is further from 1 would make any pixel black or infinite.
        const bool sound = factor[c] > 0.0 && header.exposure[c] > 1e-30 && header.exposure[c] < 1e30;
        if (!sound) refuse_line(line, "is no factor of a picture");
    }
}

void read_format(RadianceHeader& header, std::string_view line, std::string_view value) {
    const std::string_view format = trim(value);
    header.is_xyz = format == "32-bit_rle_xyze";
    if (!header.is_xyz && format != "32-bit_rle_rgbe") {
        refuse_line(line, "is not read, only 32-bit_rle_rgbe and 32-bit_rle_xyze are");
    }
}

void read_line(RadianceHeader& header, std::string_view line) {
    const auto value_of = [&](std::string_view name) -> std::optional<std::string_view> {
        if (!line.starts_with(name)) return std::nullopt;
        return line.substr(name.size());
    };
    if (const auto format = value_of("FORMAT=")) {
        read_format(header, line, *format);
    } else if (const auto exposure = value_of("EXPOSURE=")) {
        multiply_exposure(header, line, glm::dvec3(numbers_of(line, *exposure, 1)[0]));
    } else if (const auto correction = value_of("COLORCORR=")) {
        const auto rgb = numbers_of(line, *correction, 3);
        multiply_exposure(header, line, {rgb[0], rgb[1], rgb[2]});
    } else if (const auto primaries = value_of("PRIMARIES=")) {
        const auto xy = numbers_of(line, *primaries, 8);
        header.primaries = {{xy[0], xy[1]}, {xy[2], xy[3]}, {xy[4], xy[5]}, {xy[6], xy[7]}};
    }
}

/// One half of a resolution line, such as `-Y 512`.
struct Side {
    char axis;
    bool is_downwards;  ///< towards smaller coordinates
    std::int64_t length;
};

std::optional<Side> side_of(std::string_view axis, std::string_view length) {
    if (axis.size() != 2 || (axis[0] != '+' && axis[0] != '-') || (axis[1] != 'X' && axis[1] != 'Y')) return {};
    // Nine digits are enough for any size that is read, and fit.
    if (length.find_first_not_of("0123456789") != std::string_view::npos) return {};
    const std::string_view digits = length.substr(std::min(length.find_first_not_of('0'), length.size()));
    const std::int64_t number = digits.size() > 9 ? 999'999'999 : digits.empty() ? 0 : std::stoll(std::string(digits));
    return Side{axis[1], axis[0] == '-', number};
}

void read_resolution(RadianceHeader& header, std::string_view line) {
    const auto words = split_words(line);
    const auto first = words.size() == 4 ? side_of(words[0], words[1]) : std::nullopt;
    const auto second = words.size() == 4 ? side_of(words[2], words[3]) : std::nullopt;
    if (!first || !second || first->axis == second->axis) { refuse_line(line, "is no size such as -Y 512 +X 1024"); }
    header.by_columns = first->axis == 'X';
    const Side& x = header.by_columns ? *first : *second;
    const Side& y = header.by_columns ? *second : *first;
    check_picture_size(x.length, y.length);
    header.width = static_cast<int>(x.length);
    header.height = static_cast<int>(y.length);
    header.from_right = x.is_downwards;
    header.from_bottom = !y.is_downwards;  // Radiance's y goes up
}

}  // namespace

RadianceHeader radiance_header(std::string_view bytes) {
    if (!begins_as_radiance(bytes)) throw std::runtime_error(what_it_is(bytes, "it does not begin with #?"));
    RadianceHeader header;
    Lines lines(bytes);
    lines.next();
    for (std::string_view line = lines.next(); !line.empty(); line = lines.next()) read_line(header, line);
    read_resolution(header, lines.next());
    header.size = lines.at();
    return header;
}

}  // namespace render
