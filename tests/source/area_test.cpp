#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <type_traits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <lightcuts/light/incidence.hpp>
#include <lightcuts/source/area.hpp>
#include "support/random.hpp"
#include "support/statistics.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;
using Triangles = std::vector<EmissiveTriangle<V>>;

static_assert(EmissiveMesh<EmissiveTriangles<V>> && EmissiveMesh<EmissiveTriangles<float>>);

/// The rectangle [0, x] x [0, y] at z = 0, which shines along +z.
Triangles rectangle(float x, float y, const V& radiance) {
    const V a(0.0f), b(x, 0.0f, 0.0f), c(x, y, 0.0f), d(0.0f, y, 0.0f);
    return {{a, b, c, radiance}, {a, c, d, radiance}};
}

Triangles crumpled(std::size_t n, std::uint64_t seed) {
    Random random(seed);
    Triangles triangles;
    for (std::size_t i = 0; i < n; ++i) {
        const glm::dvec3 p = random.in_box(glm::dvec3(-2.0), glm::dvec3(2.0));
        const double size = random.decades(-2.0, 0.0), power = random.decades(-2.0, 2.0);
        triangles.push_back({V(p), V(p + size * random.on_sphere()), V(p + size * random.on_sphere()),
                             V(power * random.unit(), power * random.unit(), power * random.unit()),
                             random.chance(0.3)});
    }
    return triangles;
}

glm::dvec3 sum_of(const std::vector<OrientedPointLight<V>>& lights) {
    glm::dvec3 sum(0.0);
    for (const auto& l : lights) sum += glm::dvec3(l.intensity);
    return sum;
}

TEST(AreaLights, KeepThePowerOfEveryChannelAndAreOfEqualPower) {
    for (const std::size_t count : {1u, 7u, 64u, 3000u}) {
        const Triangles triangles = crumpled(50, count);
        glm::dvec3 truth(0.0);
        for (const auto& t : triangles) {
            const double area = 0.5 * glm::length(glm::cross(glm::dvec3(t.b - t.a), glm::dvec3(t.c - t.a)));
            truth += glm::dvec3(t.radiance) * area * (t.two_sided ? 2.0 : 1.0);
        }
        const auto lights = area_lights(EmissiveTriangles<V>(triangles), count);
        ASSERT_EQ(lights.size(), count);
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(sum_of(lights)[i] / truth[i], 1.0, 1e-6);
        const double share = (truth.x + truth.y + truth.z) / double(count);
        for (const auto& l : lights) {
            EXPECT_NEAR(channel_sum(l.intensity) / share, 1.0, 1e-5);
            EXPECT_NEAR(glm::length(l.axis), 1.0f, 1e-6f);
        }
    }
}

TEST(AreaLights, LieOnTheirTrianglesAndFaceTheSideThatShines) {
    const Triangles triangles = crumpled(20, 1);
    for (const auto& l : area_lights(EmissiveTriangles<V>(triangles), 1000)) {
        double nearest = 1e30;
        for (const auto& t : triangles) {
            const glm::dvec3 normal = glm::normalize(glm::cross(glm::dvec3(t.b - t.a), glm::dvec3(t.c - t.a)));
            const double facing = glm::dot(normal, glm::dvec3(l.axis));
            if (t.two_sided ? std::fabs(facing) < 0.9999 : facing < 0.9999) continue;
            const auto outside = [&](const V& from, const V& to) {  // of the edge, beyond it
                return -glm::dot(glm::cross(normal, glm::normalize(glm::dvec3(to - from))),
                                 glm::dvec3(l.position - from));
            };
            const double beyond = std::max({outside(t.a, t.b), outside(t.b, t.c), outside(t.c, t.a), 0.0});
            nearest = std::min(nearest, beyond + std::fabs(glm::dot(normal, glm::dvec3(l.position - t.a))));
        }
        EXPECT_LT(nearest, 1e-5);
    }
}

TEST(AreaLights, ShineOnBothSidesIfAsked) {
    Triangles triangles = rectangle(1.0f, 1.0f, V(1.0f));
    for (auto& t : triangles) t.two_sided = true;
    std::size_t up = 0;
    const auto lights = area_lights(EmissiveTriangles<V>(triangles), 100);
    for (const auto& l : lights) up += l.axis.z > 0.0f ? 1u : 0u;
    EXPECT_EQ(up, 50u);
    EXPECT_NEAR(sum_of(lights).x, 2.0, 1e-6);
}

/// Largest error, over many half planes and corners of the unit square, of the share of points that lie in them.
double discrepancy(const std::vector<OrientedPointLight<V>>& lights) {
    double largest = 0.0;
    for (int i = 1; i < 16; ++i) {
        for (int j = 1; j <= 16; ++j) {
            double inside = 0.0;
            for (const auto& l : lights) inside += l.position.x * 16.0f < float(i) && l.position.y * 16.0f < float(j);
            largest = std::max(largest, std::fabs(inside / double(lights.size()) - i * j / 256.0));
        }
    }
    return largest;
}

TEST(AreaLights, AreSpreadEvenlyWhateverTheTriangles) {
    Triangles fan;  // of slivers
    const V middle(0.3f, 0.4f, 0.0f);
    const auto edge = [](int i) {
        const float t = float(i % 8) / 8.0f;
        return i % 32 < 8 ? V(t, 0, 0) : i % 32 < 16 ? V(1, t, 0) : i % 32 < 24 ? V(1 - t, 1, 0) : V(0, 1 - t, 0);
    };
    for (int i = 0; i < 32; ++i) fan.push_back({middle, edge(i), edge(i + 1), V(1.0f)});
    for (const auto& triangles : {rectangle(1.0f, 1.0f, V(1.0f)), fan}) {
        for (const std::size_t count : {64u, 100u, 1024u}) {
            Mean even, independent;
            for (std::uint64_t seed = 0; seed < 20; ++seed) {
                even.add(discrepancy(area_lights(EmissiveTriangles<V>(triangles), count, ScrambledSobol{seed})));
                Random random(seed);
                std::vector<OrientedPointLight<V>> points(count);
                for (auto& p : points) p.position = V(random.in_box(glm::dvec3(0.0), glm::dvec3(1.0)));
                independent.add(discrepancy(points));
            }
            const double ratio = count > 1000 ? 0.35 : 0.65;
            EXPECT_LT(even.value(), ratio * independent.value()) << count << " lights";
        }
    }
}

TEST(TrianglePiece, IsSampledUniformly) {
    const detail::TrianglePiece<V> piece{{glm::vec2(0.0f), {1.0f, 0.0f}, {0.0f, 1.0f}}, 0, false, 0.5, V(1.0f)};
    constexpr int cells = 200;
    glm::dvec3 moments(0.0);  // of u, v and u^2
    for (int i = 0; i < cells; ++i) {
        for (int j = 0; j < cells; ++j) {
            const glm::dvec2 uv = piece.at((i + 0.5) / cells, (j + 0.5) / cells);
            moments += glm::dvec3(uv.x, uv.y, uv.x * uv.x) / double(cells * cells);
        }
    }
    EXPECT_NEAR(moments.x, 1.0 / 3.0, 1e-4);
    EXPECT_NEAR(moments.y, 1.0 / 3.0, 1e-4);
    EXPECT_NEAR(moments.z, 1.0 / 6.0, 1e-4);
}

/// Irradiance at the origin on a plane that faces +z, from a rectangle [0, x] x [0, y] at height z of radiance 1:
/// Lambert's sum over the polygon's edges.
double irradiance_of_rectangle(double x, double y, double z) {
    const double a = x / std::hypot(x, z), b = y / std::hypot(x, z), c = y / std::hypot(y, z), d = x / std::hypot(y, z);
    return 0.5 * (a * std::atan(b) + c * std::atan(d));
}

TEST(AreaLights, LightAPointAsTheirRectangleDoes) {
    Triangles triangles = rectangle(2.0f, 1.0f, V(1.0f));
    for (auto& t : triangles) {
        std::swap(t.b, t.c);  // shines down
        t.a.z = t.b.z = t.c.z = 1.5f;
    }
    double sum = 0.0;
    for (const auto& l : area_lights(EmissiveTriangles<V>(triangles), 4096)) {
        const Incidence arriving = incidence(l, V(0.0f));
        sum += arriving.geometric * double(arriving.to_light.z) * double(l.intensity.x);
    }
    EXPECT_NEAR(sum / irradiance_of_rectangle(2.0, 1.0, 1.5), 1.0, 1e-3);
}

TEST(AreaLights, FollowATexture) {
    const Triangles triangles = rectangle(1.0f, 1.0f, V(0.0f));
    // Radiance 1 + 8 x along the square: triangle 0 has corners (0,0) (1,0) (1,1), triangle 1 (0,0) (1,1) (0,1).
    const TexturedTriangles emitter(std::span<const EmissiveTriangle<V>>(triangles),
                                    [](std::uint32_t t, const glm::vec2& uv) {
                                        const float x = t == 0 ? uv.x + uv.y : uv.x;
                                        return V(1.0f + 8.0f * x, 1.0f, 0.0f);
                                    });
    const auto lights = area_lights(emitter, 500);
    EXPECT_NEAR(sum_of(lights).x, 5.0, 1e-5);
    EXPECT_NEAR(sum_of(lights).y, 1.0, 1e-5);
    EXPECT_EQ(sum_of(lights).z, 0.0);
    for (const float x : {0.25f, 0.5f, 0.75f}) {
        double left = 0.0;
        for (const auto& l : lights) left += l.position.x < x ? channel_sum(l.intensity) : 0.0;
        EXPECT_NEAR(left / 6.0, double(x * 2.0f + 4.0f * x * x) / 6.0, 0.01);
    }
}

TEST(AreaLights, AreUnbiasedOverSeeds) {
    Triangles triangles = crumpled(6, 9);
    for (auto& t : triangles) t.radiance = V(t.radiance.x);
    const auto mean_height = [](const auto& lights) {
        double sum = 0.0;
        for (const auto& l : lights) sum += double(l.position.x) * channel_sum(l.intensity);
        return sum;
    };
    double truth = 0.0;
    for (const auto& t : triangles) {
        const double area = 0.5 * glm::length(glm::cross(glm::dvec3(t.b - t.a), glm::dvec3(t.c - t.a)));
        truth += area * channel_sum(t.radiance) * double(t.a.x + t.b.x + t.c.x) / 3.0 * (t.two_sided ? 2.0 : 1.0);
    }
    Mean mean;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        mean.add(mean_height(area_lights(EmissiveTriangles<V>(triangles), 5, ScrambledSobol{seed})));
    }
    EXPECT_LT(mean.standard_errors_from(truth), one_in_a_million);
}

/// A map of square texels over the rectangle's unit square, black but for spots; its texels bound it.
class SpottedSquare : public EmissiveTriangles<V> {
public:
    explicit SpottedSquare(std::size_t size)
        : EmissiveTriangles<V>(square()), size_(size), texels_(size * size, V(0.0f)) {}

    V& texel(std::size_t x, std::size_t y) { return texels_[y * size_ + x]; }
    glm::dvec3 mean() const {
        glm::dvec3 sum(0.0);
        for (const V& t : texels_) sum += glm::dvec3(t);
        return sum / static_cast<double>(texels_.size());
    }

    static constexpr bool is_textured(std::uint32_t) { return true; }
    V radiance(std::uint32_t t, const glm::vec2& uv) const {
        const glm::vec2 p = place(t, uv);
        return texels_[cell(p.y) * size_ + cell(p.x)];
    }
    RadianceRange<V> radiance_range(std::uint32_t t, const PieceCorners& corners) const {
        const glm::vec2 a = place(t, corners[0]), b = place(t, corners[1]), c = place(t, corners[2]);
        const glm::vec2 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
        RadianceRange<V> range{V(1e30f), V(0.0f)};
        for (std::size_t y = cell(low.y); y <= cell(high.y); ++y) {
            for (std::size_t x = cell(low.x); x <= cell(high.x); ++x) {
                range.low = glm::min(range.low, texels_[y * size_ + x]);
                range.high = glm::max(range.high, texels_[y * size_ + x]);
            }
        }
        return range;
    }

private:
    static const Triangles& square() {
        static const Triangles triangles = rectangle(1.0f, 1.0f, V(0.0f));
        return triangles;
    }
    static glm::vec2 place(std::uint32_t t, const glm::vec2& uv) {
        return t == 0 ? glm::vec2(uv.x + uv.y, uv.y) : glm::vec2(uv.x, uv.x + uv.y);
    }
    std::size_t cell(float x) const {
        return std::min(static_cast<std::size_t>(x * static_cast<float>(size_)), size_ - 1);
    }

    std::size_t size_;
    std::vector<V> texels_;
};

static_assert(BoundedEmissiveMesh<SpottedSquare> && !BoundedEmissiveMesh<EmissiveTriangles<V>>);
static_assert(std::is_constructible_v<EmitterSampler<SpottedSquare>, const SpottedSquare&>);
static_assert(!std::is_constructible_v<EmitterSampler<SpottedSquare>, SpottedSquare>);  // would be gone

TEST(AreaLights, FindSpotsDownToATexelByBounds) {
    for (const std::size_t size : {7u, 256u, 509u}) {
        SpottedSquare emitter(size);
        emitter.texel(size / 3, size / 2) = V(4.0f, 1.0f, 0.0f);
        emitter.texel(size - 1, 0) = V(0.0f, 0.0f, 2.0f);
        const double cell = 1.0 / static_cast<double>(size);
        for (const std::size_t count : {1u, 64u, 1000u}) {
            const auto lights = area_lights(emitter, count);
            ASSERT_EQ(lights.size(), count);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum_of(lights)[c] / emitter.mean()[c], 1.0, 0.01);
            for (const auto& l : lights) {
                const auto is_in = [&](std::size_t x, std::size_t y) {
                    const glm::dvec2 off = glm::dvec2(l.position) / cell - glm::dvec2(x, y);
                    return off.x > -1e-3 && off.x < 1.001 && off.y > -1e-3 && off.y < 1.001;
                };
                EXPECT_TRUE(is_in(size / 3, size / 2) || is_in(size - 1, 0)) << l.position.x << " " << l.position.y;
            }
        }
    }
}

TEST(EmitterSampler, KnowsThePowerToWithinItsError) {
    Random random(5);
    SpottedSquare emitter(200);
    for (int i = 0; i < 400; ++i) {
        emitter.texel(random.below(200), random.below(200)) = V(random.decades(-2.0, 2.0), 1.0f, random.unit());
    }
    const double truth = emitter.mean().x + emitter.mean().y + emitter.mean().z;
    for (const double tolerance : {0.05, 0.0025}) {
        const EmitterSampler points(emitter, {.pieces = 16, .tolerance = tolerance});
        EXPECT_DOUBLE_EQ(points.area(), 1.0);
        EXPECT_LE(points.relative_error(), tolerance);
        EXPECT_NEAR(points.power() / truth, 1.0, 5.0 * points.relative_error());
    }
    // What runs out of cuts says so.
    const EmitterSampler rough(emitter, {.pieces = 16, .most_cuts = 16});
    EXPECT_GT(rough.relative_error(), 0.0025);
}

TEST(EmitterSampler, HasNoSamplesWhereAllIsBlack) {
    const SpottedSquare emitter(64);
    const EmitterSampler points(emitter);
    EXPECT_EQ(points.power(), 0.0);
    EXPECT_TRUE(points.samples(10).empty());
}

TEST(EmitterSampler, OfAMapOfOneColorIsThatOfPlainTriangles) {
    SpottedSquare even(32);
    for (std::size_t y = 0; y < 32; ++y) {
        for (std::size_t x = 0; x < 32; ++x) even.texel(x, y) = V(0.5f, 0.25f, 1.0f);
    }
    const Triangles triangles = rectangle(1.0f, 1.0f, V(0.5f, 0.25f, 1.0f));
    const EmissiveTriangles<V> plain(triangles);
    const auto a = EmitterSampler(even).samples(50), b = EmitterSampler(plain).samples(50);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].position, b[i].position);
        for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(a[i].intensity[c], b[i].intensity[c]);
    }
}

/// The rectangle 3 x 2, turned in space, in x by y cells.
Triangles tessellated(int x, int y) {
    const auto at = [](double u, double v) {
        return V(glm::dvec3(1.0, 2.0, 3.0) + u * glm::dvec3(2.4, 1.8, 0.0) + v * glm::dvec3(0.0, 0.0, 2.0));
    };
    Triangles triangles;
    for (int i = 0; i < x; ++i) {
        for (int j = 0; j < y; ++j) {
            const V a = at(double(i) / x, double(j) / y), b = at(double(i + 1) / x, double(j) / y);
            const V c = at(double(i + 1) / x, double(j + 1) / y), d = at(double(i) / x, double(j + 1) / y);
            triangles.push_back({a, b, c, V(1.0f)});
            triangles.push_back({a, c, d, V(1.0f)});
        }
    }
    return triangles;
}

TEST(AreaLights, OfAFlatSurfaceDoNotDependOnItsTriangles) {
    const auto distance_of = [](const Triangles& one, const Triangles& other, const auto& sampler) {
        const auto a = area_lights(EmissiveTriangles<V>(one), 100, sampler);
        const auto b = area_lights(EmissiveTriangles<V>(other), 100, sampler);
        float largest = a.size() == b.size() ? 0.0f : 1e30f;
        for (std::size_t i = 0; i < a.size(); ++i) {
            largest = std::max({largest, glm::distance(a[i].position, b[i].position),
                                glm::distance(a[i].intensity, b[i].intensity), glm::distance(a[i].axis, b[i].axis)});
        }
        return largest;
    };
    const Triangles coarse = tessellated(1, 1);
    Triangles with_flat_ones = tessellated(4, 3);
    with_flat_ones.push_back({V(1, 2, 3), V(1, 2, 3), V(1, 2, 4), V(1.0f)});
    for (const Triangles& fine : {tessellated(2, 5), tessellated(1, 200), tessellated(30, 20), with_flat_ones}) {
        EXPECT_LT(distance_of(coarse, fine, ScrambledSobol{3}), 1e-4f);
        EXPECT_LT(distance_of(coarse, fine, CenteredRecurrence{}), 1e-4f);
        EXPECT_LT(distance_of(coarse, fine, IndependentSampler{4}), 1e-4f);
    }
}

/// Where a surface is cut into as many pieces as its lights have shares, shares begin and end at corners of pieces. At
/// the edge of two walls a light would shine on one of them only.
TEST(AreaLights, OfARoomLieWithinItsWalls) {
    Triangles walls;
    for (int axis = 0; axis < 3; ++axis) {
        for (const float side : {-1.0f, 1.0f}) {
            const auto at = [&](float x, float y) {
                V p(0.0f);
                p[axis] = side, p[(axis + 1) % 3] = x, p[(axis + 2) % 3] = y;
                return p;
            };
            walls.push_back({at(-1, -1), at(1, -1), at(1, 1), V(1.0f)});
            walls.push_back({at(-1, -1), at(1, 1), at(-1, 1), V(1.0f)});
        }
    }
    const EmissiveTriangles<V> emitter(walls);
    for (const std::size_t count : {12u, 96u, 1024u, 3000u}) {
        for (const auto& light : area_lights(emitter, count, CenteredRecurrence{})) {
            int on_walls = 0;
            for (int c = 0; c < 3; ++c) on_walls += std::fabs(light.position[c]) > 1.0f - 1e-5f ? 1 : 0;
            EXPECT_EQ(on_walls, 1) << light.position.x << ' ' << light.position.y << ' ' << light.position.z;
        }
    }
}

TEST(AreaLights, LieOnAFlatSurfaceOfAnyOutline) {
    // A comb: half of its rectangle. Each light lies on the triangle that it is said to lie on.
    Triangles comb;
    for (int i = 0; i < 10; ++i) {
        const float x = float(2 * i);
        const V a(x, 0, 0), b(x + 1, 0, 0), c(x + 1, 5, 0), d(x, 5, 0);
        comb.push_back({a, b, c, V(2.0f)});
        comb.push_back({a, c, d, V(2.0f)});
    }
    const EmissiveTriangles<V> emitter(comb);
    std::vector<int> on_tooth(10);
    for (const auto& s : EmitterSampler(emitter).samples(1000)) {
        const auto tooth = static_cast<std::size_t>(s.position.x / 2.0f);
        EXPECT_LE(s.position.x, 2.0f * float(tooth) + 1.0001f);
        EXPECT_EQ(s.triangle / 2, tooth);
        EXPECT_EQ(s.normal, V(0, 0, 1));
        EXPECT_FLOAT_EQ(s.intensity.x, 2.0f * 50.0f / 1000.0f);
        ++on_tooth[tooth];
    }
    for (const int n : on_tooth) EXPECT_NEAR(n, 100, 15);
}

std::string refusal(const Triangles& triangles) {
    try {
        area_lights(EmissiveTriangles<V>(triangles), 10);
    } catch (const invalid_input& e) { return e.what(); }
    return "";
}

TEST(AreaLights, RefuseEmittersThatCannotShine) {
    using testing::HasSubstr;
    EXPECT_THAT(refusal({}), HasSubstr("its 0 triangles have no area"));
    EXPECT_THAT(refusal({{V(0.0f), V(1.0f), V(2.0f), V(1.0f)}}), HasSubstr("its 1 triangles have no area"));
    EXPECT_THAT(refusal(rectangle(1.0f, 1.0f, V(0.0f))), HasSubstr("black"));
    Triangles bad = rectangle(1.0f, 1.0f, V(1.0f));
    bad[1].radiance.y = -1.0f;
    EXPECT_THAT(refusal(bad), HasSubstr("triangle 1: radiance -1.000000 is negative"));
    bad[1].radiance.y = std::numeric_limits<float>::infinity();
    EXPECT_THAT(refusal(bad), HasSubstr("triangle 1"));
    bad = rectangle(1.0f, 1.0f, V(1.0f));
    bad[1].c.x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(refusal(bad), HasSubstr("triangle 1: a corner is not finite"));
    Triangles one_flat = rectangle(1.0f, 1.0f, V(1.0f));
    one_flat.push_back({V(0.0f), V(1.0f), V(2.0f), V(1.0f)});
    EXPECT_EQ(refusal(one_flat), "");
}

}  // namespace
}  // namespace lightcuts::test
