#include "reinhart_patches.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace daylighting {
namespace {

constexpr std::array<int, 7> tregenza_rows = {30, 30, 24, 24, 18, 12, 6};
constexpr int most_divided = 16;

}  // namespace

ReinhartPatches::ReinhartPatches(int division)
    : division_(division), rows_(static_cast<int>(tregenza_rows.size()) * division),
      row_height_(std::numbers::pi / 2.0 / (rows_ + 0.5)) {
    const auto add = [&](const glm::dvec3& center, double solid_angle, double projected) {
        centers_.push_back(center);
        solid_angles_.push_back(solid_angle);
        projected_.push_back(projected);
    };
    add({0.0, 0.0, -1.0}, 2.0 * std::numbers::pi, 0.0);
    for (int row = 0; row < rows_; ++row) {
        first_in_row_.push_back(static_cast<std::uint32_t>(size()));
        const double low = std::sin(row_height_ * row), high = std::sin(row_height_ * (row + 1));
        const double up = row_height_ * (row + 0.5), width = 2.0 * std::numbers::pi / in_row(row);
        for (int i = 0; i < in_row(row); ++i) {
            const double turn = width * i;
            add({std::cos(up) * std::sin(turn), std::cos(up) * std::cos(turn), std::sin(up)}, width * (high - low),
                width * 0.5 * (high * high - low * low));
        }
    }
    const double low = std::sin(row_height_ * rows_);
    add({0.0, 0.0, 1.0}, 2.0 * std::numbers::pi * (1.0 - low), std::numbers::pi * (1.0 - low * low));
}

int ReinhartPatches::in_row(int row) const {
    return tregenza_rows[static_cast<std::size_t>(row / division_)] * division_;
}

std::optional<int> ReinhartPatches::division_of(std::size_t patches) {
    for (int division = 1; division <= most_divided; ++division) {
        if (patches == 144u * static_cast<std::size_t>(division * division) + 2u) return division;
    }
    return std::nullopt;
}

std::uint32_t ReinhartPatches::of(const glm::dvec3& direction) const {
    if (!(direction.z > 0.0)) return 0;
    const int row = static_cast<int>(std::asin(std::fmin(direction.z, 1.0)) / row_height_);
    if (row >= rows_) return static_cast<std::uint32_t>(size() - 1);
    const int count = in_row(row);
    const double turn = std::atan2(direction.x, direction.y) / (2.0 * std::numbers::pi) * count;
    const int at = (static_cast<int>(std::lround(turn)) % count + count) % count;
    return first_in_row_[static_cast<std::size_t>(row)] + static_cast<std::uint32_t>(at);
}

}  // namespace daylighting
