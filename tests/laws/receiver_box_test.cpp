#include <algorithm>
#include <array>
#include <vector>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <lightcuts/bound/policy.hpp>
#include <lightcuts/material/phong.hpp>
#include <lightcuts/shading/transfer.hpp>
#include "laws/cluster_bound_law.hpp"
#include "support/contraction.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;
using Surface = Sum<Lambert<V>, ModifiedPhong<V>>;

/// The diffuse parts of several surfaces.
struct DiffuseParts {
    Cone normals;
    V scale;
    CosineLobe<V, Cone> cosine_lobe() const { return {normals, scale}; }
};
/// The largest bound of several glossy surfaces.
struct GlossyParts {
    std::vector<ModifiedPhong<V>> lobes;
    V upper_bound(const OffsetBox& box) const {
        V most(0.0f);
        for (const auto& lobe : lobes) most = glm::max(most, lobe.upper_bound(box));
        return most;
    }
};
/// Bounds the surfaces of several receivers; is no material.
struct SurfaceParts {
    DiffuseParts diffuse;
    GlossyParts glossy;
    template <class F>
    void for_each_component(F&& f) const {
        f(glossy);
        f(diffuse);
    }
};
static_assert(ReflectionBound<SurfaceParts, V> && !Material<SurfaceParts>);

/// Some receivers near one another, with the bound of all their surfaces.
struct Receivers {
    std::vector<Receiver<Surface>> all;
    Box box;
    SurfaceParts bound;

    Receivers(Random& random, const ClusterConfiguration& c) {
        const std::size_t count = 1 + random.below(4);
        const double size = random.chance(0.3) ? 0.0 : random.decades(-6.0, 0.3);
        const double extent = std::max(1e-6, static_cast<double>(glm::length(c.positions[0] - c.receiver)));
        const double spread = some_spread(random);
        bound.diffuse = {{}, V(0.0f)};
        for (std::size_t i = 0; i < count; ++i) {
            const V at = c.receiver + V(random.on_sphere() * (size * extent));
            const V normal(i == 0 ? glm::dvec3(c.normal) : random.near(glm::dvec3(c.normal), spread));
            const Lambert<V> diffuse{normal, V(0.2f, 0.5f, 0.9f) * static_cast<float>(random.unit())};
            const ModifiedPhong<V> glossy = MaterialMaker<ModifiedPhong<V>>::make(random, normal, c.view);
            all.emplace_back(at, Surface(diffuse, glossy));
            box = merge(box, box_of(at));
            bound.diffuse.normals = merge(bound.diffuse.normals, normal);
            bound.diffuse.scale = glm::max(bound.diffuse.scale, diffuse.cosine_lobe().scale);
            bound.glossy.lobes.push_back(glossy);
        }
    }
};

template <Light L>
std::vector<L> lights_of(Random& random, const ClusterConfiguration& c) {
    std::vector<L> lights;
    for (std::size_t i = 0; i < c.positions.size(); ++i) lights.push_back(LightMaker<L>::make(random, c, i));
    return lights;
}

/// No light exceeds, at any receiver of a box, a bound for the box: by each policy's functions, and by lanes of pairs.
template <Light L>
void expect_bounds_hold_over_boxes(std::uint64_t seed) {
    Random random(seed);
    int positive = 0;
    for (int trial = 0; trial < 40000; ++trial) {
        std::vector<Receivers> receivers;
        std::vector<std::vector<L>> lights;
        std::vector<LightCluster<L>> clusters;
        const std::size_t pairs = 1 + random.below(static_cast<std::size_t>(lane_count));
        for (std::size_t i = 0; i < pairs; ++i) {
            const ClusterConfiguration c = random_configuration(random);
            receivers.emplace_back(random, c);
            lights.push_back(lights_of<L>(random, c));
            clusters.push_back(cluster_of_all(lights.back()));
        }
        std::array<const SurfaceParts*, lane_count> bounds{};
        std::array<const LightCluster<L>*, lane_count> pointers{};
        std::array<const Box*, lane_count> boxes{};
        std::array<V, lane_count> together{};
        for (std::size_t i = 0; i < pairs; ++i) {
            bounds[i] = &receivers[i].bound;
            pointers[i] = &clusters[i];
            boxes[i] = &receivers[i].box;
        }
        reflection_bounds(bounds.data(), pointers.data(), static_cast<int>(pairs), boxes.data(), together.data());
        for (std::size_t i = 0; i < pairs; ++i) {
            const Receivers& r = receivers[i];
            const std::array<V, 4> several{together[i], TwoStageBounds{}.quick(r.bound, clusters[i], r.box),
                                           TwoStageBounds{}.tight(r.bound, clusters[i], r.box),
                                           SeparateBounds{}.quick(r.bound, clusters[i], r.box)};
            for (const Receiver<Surface>& receiver : r.all) {
                for (const L& light : lights[i]) {
                    const V transfer = glm::max(unshadowed_transfer(receiver, light),
                                                transfer_in_lane(receiver, light));
                    positive += transfer.y > 0.0f;
                    for (std::size_t b = 0; b < several.size(); ++b) {
                        for (int k = 0; k < 3; ++k) {
                            // Written so that NaN is a violation.
                            ASSERT_TRUE(transfer[k] <= several[b][k])
                                << transfer[k] << " above " << several[b][k] << ", bound " << b << ", trial " << trial;
                        }
                    }
                }
            }
        }
    }
    EXPECT_GT(positive, 100000);
}

TEST(ReceiverBox, BoundsDominateOmniLights) { expect_bounds_hold_over_boxes<OmniLight<>>(1); }
TEST(ReceiverBox, BoundsDominateOrientedLights) { expect_bounds_hold_over_boxes<OrientedPointLight<>>(2); }
TEST(ReceiverBox, BoundsDominateDistantLights) { expect_bounds_hold_over_boxes<DistantLight<>>(3); }
TEST(ReceiverBox, BoundsDominateSpots) { expect_bounds_hold_over_boxes<SpotLight<>>(4); }
TEST(ReceiverBox, BoundsDominateScatteringLights) { expect_bounds_hold_over_boxes<ScatteringPointLight<>>(6); }

/// Equal bit by bit; where products and sums are contracted, within some roundoffs.
bool same(const V& a, const V& b) {
    if (a == b) return true;
    return is_contracted && glm::all(glm::lessThanEqual(glm::abs(a - b), 1e-6f * glm::max(a, b)));
}

/// A box of one point is that point: the same bits from lanes of one receiver and from lanes of pairs.
TEST(ReceiverBox, BoxOfOnePointGivesTheBoundOfThePoint) {
    Random random(5);
    for (int trial = 0; trial < 20000; ++trial) {
        const ClusterConfiguration c = random_configuration(random);
        const auto lights = lights_of<OrientedPointLight<>>(random, c);
        const Lambert<V> material{c.normal, V(0.5f)};
        const LightCluster<OrientedPointLight<>> cluster = cluster_of_all(lights);
        const Box box = box_of(c.receiver);
        std::array<const Lambert<V>*, 3> materials{&material, &material, &material};
        std::array<const LightCluster<OrientedPointLight<>>*, 3> clusters{&cluster, &cluster, &cluster};
        std::array<const Box*, 3> boxes{&box, &box, &box};
        std::array<V, 3> units;
        reflection_bounds(materials.data(), clusters.data(), 3, boxes.data(), units.data());
        const V quick = TwoStageBounds{}.quick(material, cluster, box);
        for (const V& unit : units) ASSERT_TRUE(same(unit, quick)) << trial;
    }
}

/// Bounds of pairs do not depend on what stands in other lanes.
TEST(ReceiverBox, LanesDoNotSeeOneAnother) {
    Random random(6);
    for (int trial = 0; trial < 5000; ++trial) {
        std::vector<Receivers> receivers;
        std::vector<LightCluster<OrientedPointLight<>>> clusters;
        for (int i = 0; i < lane_count; ++i) {
            const ClusterConfiguration c = random_configuration(random);
            receivers.emplace_back(random, c);
            clusters.push_back(cluster_of_all(lights_of<OrientedPointLight<>>(random, c)));
        }
        std::array<const SurfaceParts*, lane_count> bounds{};
        std::array<const LightCluster<OrientedPointLight<>>*, lane_count> pointers{};
        std::array<const Box*, lane_count> boxes{};
        std::array<V, lane_count> together{};
        for (std::size_t i = 0; i < bounds.size(); ++i) {
            bounds[i] = &receivers[i].bound;
            pointers[i] = &clusters[i];
            boxes[i] = &receivers[i].box;
        }
        reflection_bounds(bounds.data(), pointers.data(), lane_count, boxes.data(), together.data());
        for (std::size_t i = 0; i < bounds.size(); ++i) {
            V alone(0.0f);
            reflection_bounds(&bounds[i], &pointers[i], 1, &boxes[i], &alone);
            ASSERT_TRUE(same(alone, together[i])) << trial << ' ' << i;
        }
    }
}

}  // namespace
}  // namespace lightcuts::test
