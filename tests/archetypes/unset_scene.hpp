#pragma once

#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/lightcuts.hpp>
#include "archetypes/archetypes.hpp"

namespace lightcuts::test {

/// Lights of a spectrum that its default constructor leaves unset: of each kind, some lit, some dark, some behind.
struct UnsetScene {
    std::vector<OmniLight<Unset>> bulbs;
    std::vector<OrientedPointLight<Unset>> lamps;
    std::vector<DistantLight<Unset>> suns;

    UnsetScene() {
        for (int i = 0; i < 40; ++i) {
            const float x = 0.1f * static_cast<float>(i % 7), y = 0.2f * static_cast<float>(i % 5);
            const float z = i % 4 == 0 ? -1.0f : 1.0f + x;
            const Unset intensity = i % 6 == 0 ? black<Unset>() : Unset(1.0f + x, 2.0f + y);
            bulbs.push_back({{x, y, z}, intensity});
            lamps.push_back({{y, x, z}, {0.0f, 0.0f, -1.0f}, intensity});
        }
        suns.push_back({{0.0f, 0.0f, -1.0f}, Unset(0.5f, 0.25f)});
        suns.push_back({{0.0f, 0.6f, 0.8f}, Unset(0.5f, 0.25f)});
        suns.push_back({});  // black, though Unset() is not
    }
};

/// Calls `test(material)` with each material of the library.
template <class F>
void for_each_unset_material(F&& test) {
    const glm::vec3 up(0.0f, 0.0f, 1.0f), viewer(0.6f, 0.0f, 0.8f), below(0.6f, 0.0f, -0.8f);
    const Unset color(0.5f, 0.25f);
    const Lambert<Unset> diffuse{up, color};
    test(diffuse);
    test(ModifiedPhong<Unset>(up, viewer, color, 20.0f));
    test(Ward<Unset>(up, viewer, color, 0.2f));
    test(Ggx<Unset>(up, viewer, color, 0.3f));
    test(ModifiedPhong<Unset>(up, below, color, 20.0f));
    test(Ward<Unset>(up, below, color, 0.2f));
    test(Ggx<Unset>(up, below, color, 0.3f));
    test(Sum{diffuse, Ggx<Unset>(up, viewer, color, 0.3f)});
    test(AboveHorizon{diffuse, viewer});
    test(ThinSheet{diffuse, Lambert<Unset>{-up, color}, up});
    test(Capped{diffuse, Unset(1.0f, 1.0f)});
}

inline void expect_near(const Unset& value, const Unset& expected, float relative = 1e-5f) {
    for (int c = 0; c < 2; ++c) EXPECT_NEAR(value[c], expected[c], relative * expected[c]) << "channel " << c;
}

/// The sum over the lights of a tree, one by one.
template <class L, class M>
Unset brute_force(const std::vector<L>& lights, const Receiver<M>& receiver) {
    double sum[2] = {};
    for (const L& light : lights) {
        const Incidence arriving = incidence(light, receiver.position);
        if (!(arriving.geometric > 0.0)) continue;
        const Unset reflected = receiver.material.evaluate(arriving.to_light);
        for (int c = 0; c < 2; ++c) {
            sum[c] += static_cast<double>(reflected[c]) * arriving.geometric * static_cast<double>(light.intensity[c]);
        }
    }
    return {static_cast<float>(sum[0]), static_cast<float>(sum[1])};
}

}  // namespace lightcuts::test
