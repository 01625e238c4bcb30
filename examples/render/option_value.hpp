#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

#include <glm/vec3.hpp>

#include "options.hpp"

namespace render {

/// All of `text` as a finite number.
template <class Number>
std::optional<Number> to_number(std::string_view text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    if constexpr (std::is_floating_point_v<Number>) {
        if (!std::isfinite(value)) return std::nullopt;
    }
    return value;
}

/// throws: usage_error: "OPTION VALUE: expected WANTED".
[[noreturn]] void refuse(const std::string& option, const std::string& value, const std::string& wanted);

/// throws: usage_error unless all of `text` is a number in [lowest, highest], which `wanted` says in words.
template <class Number>
Number number_in(const std::string& option, const std::string& text, Number lowest, Number highest,
                 const std::string& wanted) {
    const auto value = to_number<Number>(text);
    if (!value || *value < lowest || *value > highest) refuse(option, text, wanted);
    return *value;
}

std::vector<std::string> split(const std::string& text, char separator);

/// X,Y,Z. throws: usage_error.
glm::dvec3 vector_of(const std::string& option, const std::string& text);

/// WxH. throws: usage_error, also of pictures that are too large.
void set_size(Options& options, const std::string& text);

/// throws: usage_error unless those of the camera's options that are given go together.
void check_camera(const Options& options);

}  // namespace render
