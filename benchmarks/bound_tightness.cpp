#include "bound_tightness.hpp"

#include <array>
#include <limits>
#include <type_traits>
#include <vector>

#include <glm/common.hpp>
#include <lightcuts/shading/transfer.hpp>

#include "timing.hpp"
#include "workload.hpp"

namespace benchmark {

namespace {

/// Bounds that no valid ones can beat: the largest transfer that any light of the cluster has at the receiver.
template <class Forest>
class ExactBounds {
public:
    static constexpr bool two_stages = false;

    explicit ExactBounds(const Forest& forest) : forest_(forest) {}

    /// Evaluates every light at `receiver`, to which later bounds refer.
    void look_from(const Receiver& receiver) {
        forest_.for_each([&](std::uint32_t kind, const auto& tree) {
            const lightcuts::ClusterTree& topology = tree.topology();
            std::vector<glm::vec3>& largest = largest_[kind];
            largest.resize(topology.size());
            for (std::uint32_t n = 0; n < topology.size(); ++n) {
                largest[n] = topology.is_leaf(n)
                                 ? lightcuts::unshadowed_transfer(receiver, tree.lights()[topology.item(n)])
                                 : glm::max(largest[topology.left(n)], largest[topology.right(n)]);
            }
        });
    }

    template <class M, class C>
    glm::vec3 quick(const M&, const C& cluster, const lightcuts::Box&) const {
        glm::vec3 bound(0.0f);
        forest_.for_each([&](std::uint32_t kind, const auto& tree) {
            if constexpr (std::is_same_v<const C*, decltype(tree.clusters().data())>) {
                bound = largest_[kind][static_cast<std::size_t>(&cluster - tree.clusters().data())];
            }
        });
        return bound;
    }

private:
    const Forest& forest_;
    std::array<std::vector<glm::vec3>, Forest::kinds> largest_;
};

template <class Forest>
BoundTightness measure(const Workload& work, const Forest& forest, std::size_t max_cut) {
    const render::OpaqueOracle oracle = work.oracle();
    const lightcuts::LightcutOptions options{.max_cut = max_cut, .seed = work.options().seed, .clamp = work.clamp()};
    lightcuts::scratch_of<Forest> scratch;
    const auto cut_size = [&](const Receiver& receiver, const auto& policy) {
        lightcuts::CutResult<glm::vec3> result;
        lightcuts::shade(forest, std::span(&receiver, 1), oracle, std::span(&result, 1), scratch, options, policy);
        return static_cast<double>(result.cut_size);
    };
    BoundTightness row;
    row.lights = work.light_count();
    row.receivers = work.receivers().size();
    const auto count = static_cast<double>(row.receivers);
    ExactBounds exact(forest);
    std::vector<double> ratios;
    for (const Receiver& receiver : work.receivers()) {
        exact.look_from(receiver);
        const double least = cut_size(receiver, exact);
        const double ours = cut_size(receiver, lightcuts::TwoStageBounds{});
        row.exact += least / count;
        row.usual += ours / count;
        row.tight += cut_size(receiver, lightcuts::TwoStageBounds{.tight_band = std::numeric_limits<double>::max()}) /
                     count;
        row.separate += cut_size(receiver, lightcuts::SeparateBounds{}) / count;
        ratios.push_back(ours / least);
    }
    row.median_ratio = median(ratios);
    return row;
}

}  // namespace

BoundTightness measure_tightness(const std::string& scene, int width, int height, std::size_t max_cut) {
    const Workload work(scene, width, height);
    BoundTightness row = work.visit([&](const auto& forest) { return measure(work, forest, max_cut); });
    row.scene = scene;
    return row;
}

}  // namespace benchmark
