#include "option_value.hpp"

#include <glm/geometric.hpp>

namespace render {

namespace {

constexpr int largest_side = 1 << 16;
constexpr long long largest_picture = 1ll << 27;  ///< pixels

}  // namespace

void refuse(const std::string& option, const std::string& value, const std::string& wanted) {
    throw usage_error(option + " " + value + ": expected " + wanted);
}

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == separator) {
            parts.emplace_back();
        } else {
            parts.back() += c;
        }
    }
    return parts;
}

glm::dvec3 vector_of(const std::string& option, const std::string& text) {
    const std::vector<std::string> parts = split(text, ',');
    glm::dvec3 v(0.0);
    for (int i = 0; i < 3; ++i) {
        const auto value = parts.size() == 3 ? to_number<double>(parts[static_cast<std::size_t>(i)]) : std::nullopt;
        // What a float cannot hold cannot be rendered.
        if (!value || !std::isfinite(static_cast<float>(*value))) refuse(option, text, "three numbers X,Y,Z");
        v[i] = *value;
    }
    return v;
}

void set_size(Options& options, const std::string& text) {
    const std::vector<std::string> parts = split(text, 'x');
    const auto width = parts.size() == 2 ? to_number<int>(parts[0]) : std::nullopt;
    const auto height = parts.size() == 2 ? to_number<int>(parts[1]) : std::nullopt;
    if (!width || !height || *width < 1 || *height < 1) {
        refuse("--size", text, "WxH with a width and a height of at least one pixel, such as 640x480");
    }
    if (*width > largest_side || *height > largest_side ||
        static_cast<long long>(*width) * static_cast<long long>(*height) > largest_picture) {
        refuse("--size", text,
               "at most " + std::to_string(largest_side) + " pixels a side and " + std::to_string(largest_picture) +
                   " in all");
    }
    options.width = *width;
    options.height = *height;
}

void check_camera(const Options& options) {
    if (options.eye.has_value() != options.target.has_value()) {
        throw usage_error(std::string(options.eye ? "--eye needs --target" : "--target needs --eye") + " X,Y,Z too");
    }
    if (!options.camera.empty() && options.eye) {
        throw usage_error("--camera and --eye name two cameras: give one of them");
    }
    if (options.up && !options.eye) throw usage_error("--up needs --eye and --target");
    if (options.eye && *options.eye == *options.target) {
        throw usage_error("--target is the same point as --eye: give two that differ");
    }
    if (options.up) {
        const glm::dvec3 across = glm::cross(*options.target - *options.eye, glm::dvec3(*options.up));
        if (across == glm::dvec3(0.0)) throw usage_error("--up points along the view: give another direction");
    }
}

}  // namespace render
