#include <lightcuts/material/bounded_by.hpp>

#include <cmath>

#include <gtest/gtest.h>
#include <lightcuts/cut/lightcut.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/material/above_horizon.hpp>
#include <lightcuts/material/capped.hpp>
#include <lightcuts/material/ggx.hpp>
#include <lightcuts/material/lambert.hpp>
#include <lightcuts/material/sum.hpp>

#include "configurations.hpp"
#include "support/scene.hpp"

namespace {

using namespace lightcuts;
using material_test::Numbers;
using material_test::quick_bound;
using material_test::Surface;

using Glossy = Sum<Lambert<glm::vec3>, Ggx<glm::vec3>>;

/// Offers its values and nothing else: between a third and all of what the glossy material inside reflects.
struct Opaque {
    Glossy inside;

    glm::vec3 evaluate(const glm::vec3& to_light) const {
        const float share = 2.0f / 3.0f + std::sin(40.0f * to_light.x) / 3.0f;
        return share * inside.evaluate(to_light);
    }
};
using Bounded = BoundedBy<Opaque, Glossy>;
static_assert(Material<Opaque> && !BoundedMaterial<Opaque>);
static_assert(QuicklyBoundedMaterial<Bounded> && CompositeMaterial<Bounded> && !CosineLobeMaterial<Bounded>);
static_assert(!LaneMaterial<Bounded> && LaneMaterial<BoundedBy<Lambert<float>, Lambert<float>>>);
static_assert(CosineLobeMaterial<BoundedBy<Lambert<float>, Lambert<float>>>);
static_assert(CompositeMaterial<AboveHorizon<Bounded>> && CompositeMaterial<Sum<Bounded, Lambert<glm::vec3>>>);

Opaque opaque_at(const Surface& s) {
    return {Glossy{Lambert{s.normal, glm::vec3(0.5f, 0.3f, 0.1f)}, Ggx{s.normal, s.view, glm::vec3(0.2f), 0.25f}}};
}

TEST(BoundedBy, BoundDominatesValues) {
    Numbers numbers(1);
    for (int i = 0; i < 400; ++i) {
        const Surface s = material_test::random_surface(numbers);
        const OffsetBox box = material_test::random_box(numbers, s);
        const Opaque opaque = opaque_at(s);
        const BoundedBy m{opaque, opaque.inside};
        const glm::vec3 tight = m.upper_bound(box), quick = quick_bound(m, box);
        for (int k = 0; k < 50; ++k) {
            glm::dvec3 p;
            for (int a = 0; a < 3; ++a) p[a] = box.lo[a] + numbers.uniform(0.0, 1.0) * (box.hi[a] - box.lo[a]);
            if (!(glm::length(p) > 0.0)) continue;
            const glm::vec3 value = m.evaluate(glm::vec3(glm::normalize(p)));
            for (int c = 0; c < 3; ++c) {
                EXPECT_LE(value[c], tight[c]);
                EXPECT_LE(value[c], quick[c]);
            }
        }
    }
}

TEST(BoundedBy, ReflectsWhatTheMaterialDoesWhereverItStands) {
    Numbers numbers(2);
    for (int i = 0; i < 100; ++i) {
        const Surface s = material_test::random_surface(numbers);
        const Opaque opaque = opaque_at(s);
        const Bounded m{opaque, opaque.inside};
        const Lambert other{s.normal, glm::vec3(0.1f)};
        const glm::vec3 o = material_test::unit(numbers.direction());
        const glm::vec3 value = opaque.evaluate(o);
        EXPECT_EQ(value, m.evaluate(o));
        EXPECT_EQ(value, material_test::value_in_lane(m, o));
        const glm::vec3 sum = material_test::value_in_lane(Sum{m, other}, o);
        const glm::vec3 above = material_test::value_in_lane(AboveHorizon{m, s.normal}, o);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(value[c] + other.evaluate(o)[c], sum[c], 1e-6f * (1.0f + sum[c]));
            EXPECT_EQ(glm::dot(s.normal, o) > 0.0f ? value[c] : 0.0f, above[c]);
        }
    }
}

TEST(BoundedBy, CutsAreMuchSmallerThanUnderACap) {
    test::Room<glm::vec3> room(3);
    const auto lights = room.oriented(20'000);
    const LightTree tree(lights);
    std::uint32_t bounded_size = 0, capped_size = 0, inside_size = 0;
    for (const auto& receiver : room.glossy_receivers(20)) {
        const Opaque opaque{receiver.material};
        const Receiver bounded(receiver.position, BoundedBy{opaque, opaque.inside});
        // The least cap there is: a search for the largest value.
        glm::vec3 most(0.0f);
        Numbers numbers(4);
        for (int i = 0; i < 20'000; ++i) {
            most = glm::max(most, opaque.evaluate(material_test::unit(numbers.direction())));
        }
        const Receiver capped(receiver.position, Capped{opaque, most});
        const auto a = shade(tree, bounded), b = shade(tree, capped), c = shade(tree, receiver);
        const auto exact = exhaustive(tree, bounded);
        bounded_size += a.cut_size;
        capped_size += b.cut_size;
        inside_size += c.cut_size;
        for (int k = 0; k < 3; ++k) {
            EXPECT_LE(std::fabs(a.radiance[k] - exact.radiance[k]), a.error_bound[k] + 1e-5f * exact.radiance[k]);
        }
    }
    EXPECT_LT(bounded_size, 0.6 * capped_size);
    EXPECT_LT(bounded_size, 2.0 * inside_size);
}

#ifndef NDEBUG
TEST(BoundedByDeathTest, AnAssertionNoticesABoundThatIsExceeded) {
    const glm::vec3 up(0.0f, 0.0f, 1.0f);
    const BoundedBy m{Lambert{up, glm::vec3(0.5f)}, Lambert{up, glm::vec3(0.5f, 0.4f, 0.5f)}};
    EXPECT_DEATH(m.evaluate(up), "is_bounded");
}
#endif

}  // namespace
