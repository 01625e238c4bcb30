#pragma once

#include <cstdint>
#include <vector>

#include "scene.hpp"
#include "view.hpp"

namespace render {

/// What a camera sees of a scene at each of its instants.
class MovingView {
public:
    /// The same at all of `instants`.
    MovingView(View view, std::uint32_t instants = 1) : views_{view}, instants_(instants) {}

    /// pre: as View; `require_usable` accepts each pose of the camera.
    MovingView(const Camera& camera, const Scene& scene, int width, int height, const Lens& lens = {});

    int width() const { return views_.front().width(); }
    int height() const { return views_.front().height(); }
    std::uint32_t instants() const { return instants_; }

    const View& at(std::uint32_t instant) const { return views_.size() > 1 ? views_[instant] : views_.front(); }

private:
    std::vector<View> views_;  ///< one, or one for each instant
    std::uint32_t instants_;
};

/// `camera` in one of its poses.
Camera posed(const Camera& camera, const CameraPose& pose);

}  // namespace render
