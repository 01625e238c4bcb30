#include "moving_view.hpp"

#include <algorithm>

namespace render {

Camera posed(const Camera& camera, const CameraPose& pose) {
    Camera there = camera;
    there.eye = pose.eye;
    there.target = pose.target;
    there.up = pose.up;
    there.at_instants.clear();
    return there;
}

MovingView::MovingView(const Camera& camera, const Scene& scene, int width, int height, const Lens& lens)
    : instants_(static_cast<std::uint32_t>(std::max<std::size_t>(scene.instants.size(), 1))) {
    for (const CameraPose& pose : camera.at_instants) {
        views_.emplace_back(posed(camera, pose), scene.origin, width, height, lens);
    }
    if (views_.empty()) views_.emplace_back(camera, scene.origin, width, height, lens);
}

}  // namespace render
