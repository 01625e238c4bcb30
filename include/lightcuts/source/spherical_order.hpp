#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <type_traits>

namespace lightcuts::detail {

/// Visits the pixels of a latitude-longitude map in an order in which consecutive ones lie close together on the
/// sphere. The map is halved again and again: a rectangle of pixels across the side that is longer on the sphere, where
/// a row's length shrinks with the cosine of its latitude; the half that is closer to the pixel visited last comes
/// first.
template <class Visit>
class SphericalOrder {
public:
    SphericalOrder(std::uint32_t width, std::uint32_t height, Visit& visit)
        : height_(height), across_(2.0 * std::numbers::pi / width), up_(std::numbers::pi / height), visit_(visit) {
        walk({0, 0, width, height});
    }

private:
    struct Rectangle {
        std::uint32_t x0, y0, x1, y1;
    };

    void walk(const Rectangle& r) {
        const std::uint32_t columns = r.x1 - r.x0, rows = r.y1 - r.y0;
        if (columns == 1 && rows == 1) {
            visit_(r.x0, r.y0);
            x_ = r.x0;
            y_ = r.y0;
            return;
        }
        const bool beside = rows == 1 || (columns > 1 && across_ * columns * widest_cosine(r) >= up_ * rows);
        const std::uint32_t x = r.x0 + columns / 2, y = r.y0 + rows / 2;
        const Rectangle low = beside ? Rectangle{r.x0, r.y0, x, r.y1} : Rectangle{r.x0, r.y0, r.x1, y};
        const Rectangle high = beside ? Rectangle{x, r.y0, r.x1, r.y1} : Rectangle{r.x0, y, r.x1, r.y1};
        const bool low_first = beside ? 2.0 * x_ < r.x0 + r.x1 : 2.0 * y_ < r.y0 + r.y1;
        walk(low_first ? low : high);
        walk(low_first ? high : low);
    }
    /// The largest cosine of a latitude within the rows of `r`.
    double widest_cosine(const Rectangle& r) const {
        const std::uint32_t equator = height_ / 2;
        if (r.y0 <= equator && equator <= r.y1) return 1.0;
        return std::sin(up_ * (r.y1 < equator ? r.y1 : r.y0));
    }

    std::uint32_t height_;
    double across_, up_;  ///< width and height of a pixel at the equator, radians
    Visit& visit_;
    std::uint32_t x_ = 0, y_ = 0;  ///< the last pixel
};

/// Calls `visit(x, y)` once for each pixel of a latitude-longitude map of `width` x `height` pixels, in an order in
/// which consecutive ones lie close together on the sphere. pre: width > 0, height > 0. cost: O(pixels)
template <class Visit>
void visit_in_spherical_order(std::uint32_t width, std::uint32_t height, Visit&& visit) {
    SphericalOrder<std::remove_reference_t<Visit>>(width, height, visit);
}

}  // namespace lightcuts::detail
