#include <lightcuts/product/envelope.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <lightcuts/material/ggx.hpp>
#include <lightcuts/material/lambert.hpp>
#include <lightcuts/material/phase_function.hpp>
#include <lightcuts/material/phong.hpp>
#include <lightcuts/material/ward.hpp>
#include "support/random.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;

/// Lights where lobes are large and where they are not: near the mirror direction of one of the lobes, near its
/// horizon, anywhere.
glm::dvec3 some_direction(Random& random, const glm::dvec3& normal, const glm::dvec3& mirror) {
    const double kind = random.unit();
    if (kind < 0.5) return random.near(mirror, random.decades(-7.0, 0.0));
    if (kind < 0.7) {
        const glm::dvec3 side = random.on_sphere();
        const glm::dvec3 level = glm::normalize(side - glm::dot(side, normal) * normal);
        return random.near(level, random.decades(-5.0, -1.0));
    }
    return random.on_sphere();
}

/// The bound of merged envelopes dominates each lobe at every direction of a box.
template <class MakeLobe>
void expect_dominates(const MakeLobe& make_lobe) {
    for (std::uint64_t seed = 0; seed < 100'000; ++seed) {
        Random random(seed);
        const double spread = random.chance(0.2) ? 0.0 : random.decades(-6.0, 0.2);
        const glm::dvec3 normal = random.on_sphere(), view = random.near(normal, 1.6);
        const std::size_t count = 1 + random.below(5);
        std::vector<decltype(make_lobe(random, V(), V()))> lobes;
        glm::dvec3 mirror = normal;
        for (std::size_t i = 0; i < count; ++i) {
            const V n(glm::normalize(V(random.near(normal, spread)))), v(glm::normalize(V(random.near(view, spread))));
            lobes.push_back(make_lobe(random, n, v));
            if constexpr (requires { lobes.back().main_direction(); }) {
                const glm::dvec3 main(lobes.back().main_direction());
                if (glm::length(main) > 0.0) mirror = main;
            }
        }
        auto envelope = detail::envelope_of_lobe(lobes[0]);
        for (const auto& lobe : lobes) envelope = merge(envelope, detail::envelope_of_lobe(lobe));

        const double distance = random.decades(-3.0, 3.0);
        std::vector<V> offsets;
        const glm::dvec3 middle = some_direction(random, normal, glm::normalize(mirror));
        const double size = random.chance(0.3) ? 0.0 : random.decades(-7.0, 0.5);
        for (int i = 0; i < 6; ++i)
            offsets.push_back(V(distance * (middle + size * random.in_box({-1, -1, -1}, {1, 1, 1}))));
        Box box;
        for (const V& o : offsets) box = merge(box, box_of(o));
        const V bound = detail::upper_bound_over<V>(envelope, {glm::dvec3(box.lo), glm::dvec3(box.hi)});
        for (const V& o : offsets) {
            if (o == V(0.0f)) continue;
            const V direction(glm::normalize(glm::dvec3(o)));
            for (const auto& lobe : lobes) {
                const V value = lobe.evaluate(direction);
                for (int c = 0; c < 3; ++c) ASSERT_LE(value[c], bound[c]) << seed;
            }
        }
    }
}

TEST(Envelope, OfLambertDominatesEachLobe) {
    expect_dominates([](Random& random, const V& n, const V&) {
        return Lambert<V>{n, V(random.real(0, 1), random.real(0, 1), 0.5f)};
    });
}
TEST(Envelope, OfPhongDominatesEachLobe) {
    expect_dominates([](Random& random, const V& n, const V& v) {
        return ModifiedPhong<V>(n, v, V(random.real(0, 1), 0.0f, 1.0f),
                                random.chance(0.1) ? 0.0f : static_cast<float>(random.decades(-1.0, 6.0)));
    });
}
TEST(Envelope, OfGgxDominatesEachLobe) {
    expect_dominates([](Random& random, const V& n, const V& v) {
        return Ggx<V>(n, v, V(random.real(0, 1), 0.04f, 0.0f), static_cast<float>(random.decades(-7.0, 0.3)),
                      random.real(0, 1));
    });
}
TEST(Envelope, OfGgxWithSeparableShadowingDominatesEachLobe) {
    expect_dominates([](Random& random, const V& n, const V& v) {
        return Ggx<V, SeparableShadowing>(n, v, V(random.real(0, 1), 0.04f, 0.0f),
                                          static_cast<float>(random.decades(-4.0, 0.3)));
    });
}
TEST(Envelope, OfHenyeyGreensteinDominatesEachPhaseFunction) {
    for (const bool alike : {true, false}) {
        expect_dominates([alike](Random& random, const V&, const V& v) {
            const float g = alike ? 0.7f : static_cast<float>(1.0 - random.decades(-5.0, 0.3));
            return HenyeyGreenstein<V>(v, V(random.real(0, 1), 1.0f, 0.0f), random.chance(0.1) ? 0.0f : g);
        });
    }
}

/// Nowhere does a lobe reflect more than near its main direction, which is longer for a sharper lobe.
template <class MakeLobe>
void expect_main_direction(const MakeLobe& make_lobe) {
    Random random(3);
    const V n(0.0f, 0.0f, 1.0f), v = glm::normalize(V(0.6f, 0.0f, 0.8f));
    float before = 0.0f;
    for (const float sharpness : {0.05f, 0.5f, 0.95f}) {
        const auto lobe = make_lobe(n, v, sharpness);
        const V main = lobe.main_direction();
        EXPECT_GT(glm::length(main), before);
        EXPECT_LE(glm::length(main), 4.0001f);
        before = glm::length(main);
        if (sharpness < 0.9f) continue;
        float elsewhere = 0.0f;
        for (int i = 0; i < 10'000; ++i) {
            const V o(random.on_sphere());
            if (glm::dot(o, glm::normalize(main)) < 0.9f) elsewhere = std::max(elsewhere, lobe.evaluate(o).x);
        }
        EXPECT_GT(lobe.evaluate(glm::normalize(main)).x, 2.0f * elsewhere);
    }
}

TEST(MainDirection, IsWhereALobeReflectsMost) {
    expect_main_direction(
        [](const V& n, const V& v, float s) { return ModifiedPhong<V>(n, v, V(1.0f), std::exp2(8.0f * s)); });
    expect_main_direction([](const V& n, const V& v, float s) { return Ggx<V>(n, v, V(1.0f), 1.0f - s); });
    expect_main_direction([](const V& n, const V& v, float s) { return Ward<V>(n, v, V(1.0f), 1.0f - s); });
    expect_main_direction([](const V&, const V& v, float s) { return HenyeyGreenstein<V>(v, V(1.0f), s); });
}

}  // namespace
}  // namespace lightcuts::test
