#include "site_sky.hpp"

#include <glm/geometric.hpp>
#include <render/stopwatch.hpp>

namespace relight {

SiteSky::SiteSky(const Directions& directions, const render::RayScene& rays, Sides sides)
    : directions_(directions), rays_(rays), sides_(sides), shares_(directions.size()), asked_(directions.size()),
      sums_(directions.tree.size()), counts_(directions.tree.size()) {}

void SiteSky::look(const Site& site) {
    order_.clear();
    traced_.clear();
    const auto add = [&](std::uint32_t i) {
        order_.push_back(i);
        traced_.push_back(directions_.leaves[i]);
    };
    const auto count = static_cast<std::uint32_t>(directions_.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        const bool is_above = glm::dot(site.normal, directions_.leaves[i]) > site.horizon;
        asked_[i] = is_above || sides_ == Sides::both ? 1 : 0;
        if (is_above) add(i);
    }
    const std::size_t above = order_.size();
    if (sides_ == Sides::both) {
        for (std::uint32_t i = 0; i < count; ++i) {
            if (!(glm::dot(site.normal, directions_.leaves[i]) > site.horizon)) add(i);
        }
    }
    count_ = order_.size();
    answers_.resize(count_);
    const render::Stopwatch watch;
    trace(site.front, 0, above);
    trace(site.back, above, count_);
    ray_seconds_ += watch.seconds();
    for (std::size_t k = 0; k < count_; ++k) shares_[order_[k]] = answers_[k];
    if (count_ < directions_.size()) fill();
}

void SiteSky::trace(const glm::vec3& from, std::size_t begin, std::size_t end) {
    sky_.look(rays_, from, std::span(traced_).subspan(begin, end - begin),
              std::span(answers_).subspan(begin, end - begin));
}

void SiteSky::fill() {
    const lightcuts::ClusterTree& tree = directions_.tree;
    for (std::uint32_t n = 0; n < tree.size(); ++n) {
        if (tree.is_leaf(n)) {
            const std::uint32_t i = tree.item(n);
            counts_[n] = asked_[i] != 0 ? 1.0f : 0.0f;
            sums_[n] = asked_[i] != 0 ? shares_[i] : 0.0f;
        } else {
            const std::uint32_t right = tree.right(n), left = tree.left(n);
            counts_[n] = counts_[left] + counts_[right];
            sums_[n] = sums_[left] + sums_[right];
        }
    }
    // From parents to children: sums become means.
    for (std::uint32_t n = tree.root() + 1; n-- > 0;) {
        if (n == tree.root()) sums_[n] = counts_[n] > 0.0f ? sums_[n] / counts_[n] : 0.0f;
        if (tree.is_leaf(n)) {
            if (asked_[tree.item(n)] == 0) shares_[tree.item(n)] = sums_[n];
            continue;
        }
        for (const std::uint32_t child : {tree.left(n), tree.right(n)}) {
            sums_[child] = counts_[child] > 0.0f ? sums_[child] / counts_[child] : sums_[n];
        }
    }
}

}  // namespace relight
