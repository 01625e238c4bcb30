#include "benchmarks/cube_map_envelope.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <lightcuts/material/ggx.hpp>
#include <lightcuts/material/phong.hpp>

#include "support/random.hpp"

namespace {

using benchmark::CubeMapEnvelope;
using lightcuts::test::Random;
using V = glm::vec3;

/// At every direction of a box, the corners and the axes of the cube too, each of the merged lobes is below the bound.
template <class MakeLobe>
void expect_dominates(const MakeLobe& make_lobe) {
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        Random random(seed);
        std::vector<decltype(make_lobe(random, V(), V()))> lobes;
        const glm::dvec3 normal = random.on_sphere(), view = random.near(normal, 1.5);
        CubeMapEnvelope<float> envelope;
        for (std::size_t i = 0; i < 1 + seed % 3; ++i) {
            lobes.push_back(make_lobe(random, V(glm::normalize(V(random.near(normal, 0.3)))),
                                      V(glm::normalize(V(random.near(view, 0.3))))));
            envelope = merge(envelope, CubeMapEnvelope<float>(lobes.back()));
        }
        for (int i = 0; i < 20; ++i) {
            glm::dvec3 middle = random.chance(0.5) ? glm::dvec3(lobes[0].main_direction()) : random.on_sphere();
            // Where cells and faces meet.
            if (random.chance(0.3)) middle = glm::round(3.0 * middle / glm::length(middle)) / 3.0;
            const double size = random.chance(0.3) ? 0.0 : random.decades(-6.0, 0.3);
            const lightcuts::OffsetBox box{middle - size, middle + size};
            const float bound = envelope.upper_bound(box);
            for (int k = 0; k < 12; ++k) {
                glm::dvec3 offset = middle + size * random.in_box({-1, -1, -1}, {1, 1, 1});
                if (k < 8) offset = middle + size * glm::dvec3(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1);
                if (glm::length(offset) == 0.0) continue;
                for (const auto& lobe : lobes) ASSERT_LE(lobe.evaluate(V(glm::normalize(offset))), bound) << seed;
            }
        }
    }
}

TEST(CubeMapEnvelope, DominatesPhongsLobes) {
    expect_dominates([](Random& random, const V& n, const V& v) {
        return lightcuts::ModifiedPhong<float>(n, v, random.real(0, 1), static_cast<float>(random.decades(0, 3)));
    });
}

TEST(CubeMapEnvelope, DominatesGgxLobes) {
    expect_dominates([](Random& random, const V& n, const V& v) {
        return lightcuts::Ggx<float>(n, v, random.real(0, 1), static_cast<float>(random.decades(-2, 0)));
    });
}

TEST(CubeMapEnvelope, OfNothingIsBlack) {
    EXPECT_EQ(CubeMapEnvelope<float>().upper_bound({glm::dvec3(-1.0), glm::dvec3(1.0)}), 0.0f);
}

}  // namespace
