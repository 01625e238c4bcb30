#pragma once

#include <vector>

#include <lightcuts/lightcuts.hpp>

/// The radiance of one glossy point under a row of lamps.
inline float shading() {
    using V = glm::vec3;
    std::vector<lightcuts::OrientedPointLight<>> lamps;
    for (int i = 0; i < 1000; ++i) {
        lamps.push_back({V(0.01f * static_cast<float>(i), 1.0f, 3.0f), V(0.0f, 0.0f, -1.0f), V(1.0f)});
    }
    const lightcuts::LightTree tree(lamps);
    const V up(0.0f, 0.0f, 1.0f);
    const lightcuts::Sum material{lightcuts::Lambert<V>{up, V(0.5f)}, lightcuts::Ggx<V>{up, up, V(0.04f), 0.3f}};
    return lightcuts::shade(tree, lightcuts::Receiver(V(0.0f), material), lightcuts::AlwaysVisible{}).radiance.r;
}
