#include <lightcuts/material/sum.hpp>

#include <gtest/gtest.h>
#include <lightcuts/material/capped.hpp>
#include <lightcuts/material/ggx.hpp>
#include <lightcuts/material/lambert.hpp>
#include <lightcuts/material/phong.hpp>

#include "configurations.hpp"

namespace {

using namespace lightcuts;
using material_test::Numbers;
using material_test::quick_bound;
using material_test::Surface;

/// Has no bound.
struct Unbounded {
    float evaluate(const glm::vec3& o) const { return o.z > 0.0f ? o.z : 0.0f; }
};
/// Has no state.
struct Black {
    float evaluate(const glm::vec3&) const { return 0.0f; }
    float upper_bound(const OffsetBox&) const { return 0.0f; }
};

using Glossy = Sum<Lambert<float>, Ggx<float>>;
static_assert(QuicklyBoundedMaterial<Glossy>);
static_assert(CompositeMaterial<Glossy>);
static_assert(!CosineLobeMaterial<Glossy>);
static_assert(Material<Sum<Lambert<float>, Unbounded>>);
static_assert(!BoundedMaterial<Sum<Lambert<float>, Unbounded>>);
static_assert(BoundedMaterial<Sum<Lambert<float>, Capped<Unbounded>>>);
static_assert(sizeof(Sum<Lambert<float>>) == sizeof(Lambert<float>));
static_assert(sizeof(Sum<Lambert<float>, Black>) == sizeof(Lambert<float>));

constexpr glm::vec3 up(0.0f, 0.0f, 1.0f);

TEST(Sum, AddsValuesAndBounds) {
    Numbers numbers(1);
    for (int i = 0; i < 1000; ++i) {
        const Surface s = material_test::random_surface(numbers);
        const OffsetBox box = material_test::random_box(numbers, s);
        const glm::vec3 o = material_test::unit(numbers.direction());
        const Lambert a{s.normal, 0.5f};
        const Ggx b{s.normal, s.view, 0.1f, 0.3f};
        const ModifiedPhong c{s.normal, s.view, 0.2f, 20.0f};
        const Sum sum{a, b, c};
        EXPECT_EQ(a.evaluate(o) + (b.evaluate(o) + c.evaluate(o)), sum.evaluate(o));
        EXPECT_EQ(a.upper_bound(box) + (b.upper_bound(box) + c.upper_bound(box)), sum.upper_bound(box));
        EXPECT_EQ(quick_bound(a, box) + (quick_bound(b, box) + quick_bound(c, box)), quick_bound(sum, box));
    }
}

TEST(Sum, VisitsTheComponentsOfNestedSumsInOrder) {
    const Sum sum{Lambert{up, 0.1f}, Sum{Lambert{up, 0.2f}, Ggx{up, up, 0.1f, 0.3f}}, Lambert{up, 0.4f}};
    int diffuse = 0;
    int others = 0;
    float albedos = 0.0f;
    sum.for_each_component([&]<class M>(const M& m) {
        if constexpr (CosineLobeMaterial<M>) {
            ++diffuse;
            albedos = 10.0f * albedos + m.albedo;
        } else {
            ++others;
        }
    });
    EXPECT_EQ(3, diffuse);
    EXPECT_EQ(1, others);
    EXPECT_FLOAT_EQ(10.0f + 2.0f + 0.4f, albedos);
}

TEST(Sum, UsesTheOnlyBoundOfAComponentWithoutAQuickOne) {
    const Sum sum{Lambert{up, 0.5f}, Capped{Unbounded{}, 3.0f}};
    const OffsetBox box{{-1, -1, 1}, {1, 1, 2}};
    EXPECT_EQ(quick_bound(Lambert{up, 0.5f}, box) + 3.0f, quick_bound(sum, box));
}

}  // namespace
