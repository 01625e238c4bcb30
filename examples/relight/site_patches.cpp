#include "site_patches.hpp"

#include <algorithm>

#include <glm/geometric.hpp>
#include <render/stopwatch.hpp>

namespace relight {

void SitePatches::look(const Site& site) {
    order_.clear();
    traced_.clear();
    std::fill(shares_.begin(), shares_.end(), 0.0f);
    std::fill(asked_.begin(), asked_.end(), std::uint8_t{0});
    const auto count = static_cast<std::uint32_t>(patches_.size());
    const auto is_above = [&](std::uint32_t i) {
        const glm::vec3 way = patches_[i].position - site.front;
        return glm::dot(site.normal, way) > site.horizon * glm::length(way);
    };
    // Off the surface that the site itself lies on.
    const float clearance = glm::distance(site.front, site.back);
    const auto add_side = [&](const glm::vec3& from, bool above) {
        for (std::uint32_t i = 0; i < count; ++i) {
            const float solid_angle = patches_.solid_angle(i, from, clearance);
            if (!(solid_angle > 0.0f) || is_above(i) != above) continue;
            shares_[i] = solid_angle;
            asked_[i] = 1;
            order_.push_back(i);
            traced_.push_back(ends_[i]);
        }
    };
    add_side(site.front, true);
    const std::size_t above = order_.size();
    if (sides_ == Sides::both) add_side(site.back, false);
    answers_.resize(order_.size());
    const render::Stopwatch watch;
    const auto trace = [&](const glm::vec3& from, std::size_t begin, std::size_t end) {
        queries_.look_at(rays_, from, std::span(traced_).subspan(begin, end - begin),
                         std::span(answers_).subspan(begin, end - begin));
    };
    trace(site.front, 0, above);
    trace(site.back, above, order_.size());
    ray_seconds_ += watch.seconds();
    for (std::size_t k = 0; k < order_.size(); ++k) shares_[order_[k]] *= answers_[k];
}

}  // namespace relight
