#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <lightcuts/piecewise/piecewise_constant.hpp>

#include "seen_points.hpp"
#include "site.hpp"

namespace relight {

/// Points by triangle, and the cuts of these triangles' corners.
class CornerCuts {
public:
    /// `read(site, cut)`: called once for each site at a corner of a triangle that has a point, from the threads of the
    /// calling arena.
    CornerCuts(const Sites& sites, const SeenPoints& seen,
               const std::function<void(std::uint32_t, lightcuts::PiecewiseConstant<float>&)>& read);

    /// Number of triangles with points.
    std::size_t group_count() const { return begins_.size() - 1; }
    /// The points of a triangle.
    std::span<const std::uint32_t> group(std::size_t i) const {
        return std::span(order_).subspan(begins_[i], begins_[i + 1] - begins_[i]);
    }
    /// pre: the site is at a corner of one of the triangles.
    const lightcuts::PiecewiseConstant<float>& of_site(std::uint32_t site) const { return cuts_[cut_of_[site]]; }

    double mean_size() const;
    std::size_t size() const { return cuts_.size(); }

private:
    std::vector<std::uint32_t> order_;   ///< of points: by triangle
    std::vector<std::size_t> begins_;    ///< in `order_`, of each triangle's points; and the end
    std::vector<std::uint32_t> cut_of_;  ///< by site, in `cuts_`
    std::vector<lightcuts::PiecewiseConstant<float>> cuts_;
};

}  // namespace relight
