#include <algorithm>
#include <cstdio>
#include <vector>

#include <gtest/gtest.h>

#include <lightcuts/cut/lightcut.hpp>
#include "support/scene.hpp"

namespace lightcuts::test {
namespace {

/// The best that any bound could do: the largest unshadowed transfer of the lights below the node.
template <Light L>
struct TrueMaximum {
    static constexpr bool two_stages = false;
    const LightTree<L>& tree;

    template <class M>
    material_spectrum<M> quick(const M& material, const LightCluster<L>& cluster, const Box& place) const {
        using S = material_spectrum<M>;
        const ClusterTree& topology = tree.topology();
        const auto node = static_cast<ClusterTree::node_index>(&cluster - tree.clusters().data());
        const Receiver<const M&> receiver(place.lo, material);
        S largest{};
        for (ClusterTree::node_index n = topology.left_leaf(node); n <= node; ++n) {
            if (!topology.is_leaf(n)) continue;
            const S transfer = unshadowed_transfer(receiver, tree.lights()[topology.item(n)]);
            largest = make_spectrum<S>([&](int c) { return std::max(channel(largest, c), channel(transfer, c)); });
        }
        return largest;
    }
};

/// Cut size with the library's bounds over that with true maxima.
template <class L, class M>
double looseness(const std::vector<L>& lights, const std::vector<Receiver<M>>& receivers, const char* name) {
    const LightTree<L> tree(lights);
    const LightcutOptions options{.error_ratio = 0.02f, .max_cut = 0, .exhaustive_below = 0};
    double ours = 0.0, separate = 0.0, best = 0.0;
    for (const auto& receiver : receivers) {
        ours += shade(tree, receiver, AlwaysVisible{}, options).cut_size;
        separate += shade(tree, receiver, AlwaysVisible{}, options, SeparateBounds{}).cut_size;
        best += shade(tree, receiver, AlwaysVisible{}, options, TrueMaximum<L>{tree}).cut_size;
    }
    const double n = static_cast<double>(receivers.size());
    std::printf(
        "[ FIGURE   ] cut size, %s: %.1f with the default bounds, %.1f with separate ones, %.1f with true maxima\n",
        name, ours / n, separate / n, best / n);
    EXPECT_GE(separate, best) << name;
    EXPECT_GE(ours, best) << name;
    return ours / best;
}

// Figures of a small scene, so that a bound that is valid but useless is noticed. The benchmark `tightness` has the
// larger ones.
TEST(Tightness, CutsAreNearlyThoseOfTrueMaxima) {
    Room<glm::vec3> room(21);
    const auto diffuse = room.diffuse_receivers(60);
    const auto glossy = room.glossy_receivers(60);
    EXPECT_LT(looseness(room.omni(4000), diffuse, "omni lights, diffuse"), 1.4);
    EXPECT_LT(looseness(room.oriented(4000), diffuse, "oriented lights on turned walls, diffuse"), 1.4);
    EXPECT_LT(looseness(room.oriented(4000), glossy, "oriented lights on turned walls, glossy"), 2.0);
    EXPECT_LT(looseness(room.distant(4000), diffuse, "directional lights, diffuse"), 1.15);
    EXPECT_LT(looseness(room.spot(4000), diffuse, "spot lights, diffuse"), 2.0);
}

// For a single cluster at one point nothing is lost but the margin for rounding.
TEST(Tightness, BoundOfOnePointIsExact) {
    Random random(22);
    for (int i = 0; i < 20000; ++i) {
        const glm::vec3 position(random.on_sphere() * random.between(0.5, 4.0));
        const OrientedPointLight<> light{position, glm::vec3(random.on_sphere()), glm::vec3(1.0f), {}};
        const Lambert<glm::vec3> material{glm::vec3(random.on_sphere()), glm::vec3(0.5f)};
        const LightCluster<OrientedPointLight<>> cluster = cluster_of(light);
        const float exact = unshadowed_transfer(Receiver<const Lambert<glm::vec3>&>(glm::vec3(0.0f), material), light)
                                .x;
        const float quick = TwoStageBounds{}.quick(material, cluster, box_of(glm::vec3(0.0f))).x;
        const float tight = TwoStageBounds{}.tight(material, cluster, box_of(glm::vec3(0.0f))).x;
        EXPECT_LE(tight, exact * 1.02f + 1e-5f);
        EXPECT_LE(quick, exact * 1.02f + 1e-5f);
    }
}

}  // namespace
}  // namespace lightcuts::test
