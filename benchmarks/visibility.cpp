/// What it is worth to know that whole clusters are hidden: cuts, rays, time and error without that knowledge, limited
/// and not; with what `HiddenLights` proves at each point; and with all of it. Processor time of one thread.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <CLI/CLI.hpp>
#include <glm/vec3.hpp>
#include <lightcuts/bound/policy.hpp>
#include <lightcuts/tree/build/divide.hpp>
#include <lightcuts/tree/leaf_order.hpp>

#include "error_sum.hpp"
#include "figures.hpp"
#include "rays/opaque_mesh.hpp"
#include "rays/proving_oracle.hpp"
#include "timing.hpp"
#include "workload.hpp"

namespace {

using namespace benchmark;

/// The usual bounds, and 0 for clusters of which no light is visible from a receiver.
template <class Forest>
class HiddenKnown {
public:
    static constexpr bool two_stages = false;

    HiddenKnown(const Forest& forest, const render::OpaqueOracle& oracle) : forest_(forest), oracle_(oracle) {}

    /// Asks for every light; later bounds are those of this receiver.
    void look_from(const Receiver& receiver) {
        forest_.for_each([&](std::uint32_t kind, const auto& tree) {
            const lightcuts::ClusterTree& topology = tree.topology();
            visible_[kind].resize(topology.size());
            for (std::uint32_t n = 0; n < topology.size(); ++n) {
                visible_[kind][n] = topology.is_leaf(n)
                                        ? oracle_(receiver, tree.lights()[topology.item(n)]) > 0.0f
                                        : visible_[kind][topology.left(n)] || visible_[kind][topology.right(n)];
            }
        });
    }

    template <class M, class C>
    glm::vec3 quick(const M& material, const C& cluster, const lightcuts::Box& receivers) const {
        bool visible = true;
        forest_.for_each([&](std::uint32_t kind, const auto& tree) {
            if constexpr (std::is_same_v<const C*, decltype(tree.clusters().data())>) {
                visible = visible_[kind][static_cast<std::size_t>(&cluster - tree.clusters().data())];
            }
        });
        return visible ? usual_.quick(material, cluster, receivers) : glm::vec3(0.0f);
    }

private:
    const Forest& forest_;
    const render::OpaqueOracle& oracle_;
    lightcuts::TwoStageBounds usual_;
    std::array<std::vector<bool>, Forest::kinds> visible_;
};

/// The receivers ordered such that neighbors are alike in place and normal.
std::vector<std::uint32_t> by_place(const Workload& work) {
    std::vector<lightcuts::OrientedItem> items;
    for (const render::SurfacePoint& p : work.points()) items.push_back({p.position, p.geometric_normal, 1.0f});
    return lightcuts::in_leaf_order(lightcuts::divide(items, lightcuts::LongestAxis{})).items;
}

/// Where the shadow rays of the first `count` of some receivers start.
lightcuts::ReceiverBox box_of_group(const Workload& work, std::span<const std::uint32_t> order, std::size_t count) {
    lightcuts::ReceiverBox group;
    bool alike = true;
    for (const std::uint32_t i : order.first(std::min(count, order.size()))) {
        const lightcuts::ReceiverBox one = lightcuts::box_of(work.receivers()[i]);
        const bool is_first = lightcuts::is_empty(group.box);
        group.box = lightcuts::merge(group.box, one.box);
        if (is_first) group.horizon = one.horizon;
        alike = alike && one.horizon && one.horizon->normal == group.horizon->normal;
        if (alike) group.horizon->positions = lightcuts::merge(group.horizon->positions, one.horizon->positions);
    }
    if (!alike) group.horizon.reset();
    return group;
}

struct Row {
    double cut = 0, rays = 0, at_limit = 0, time = 0;
    ErrorSum error;
};

template <class Forest>
void measure(const Workload& work, const Forest& forest, std::size_t limit) {
    const render::OpaqueOracle oracle = work.oracle();
    lightcuts::OccluderMesh mesh;
    const double set_up = seconds([&] { mesh = render::opaque_mesh(work.scene()); });
    const render::ProvingOracle proving(work.scene(), work.rays(), mesh);
    lightcuts::SharedProofs proofs;
    const render::ProvingOracle sharing(work.scene(), work.rays(), mesh, &proofs);
    std::printf("  %zu triangles, %.1f bytes each, set up in %.3f s; %zu lights, %zu points\n", mesh.size(),
                static_cast<double>(mesh.memory_bytes()) / static_cast<double>(std::max<std::size_t>(mesh.size(), 1)),
                set_up, work.light_count(), work.receivers().size());
    lightcuts::scratch_of<Forest> scratch;
    lightcuts::EstimateScratch<glm::vec3> sum_scratch;
    std::vector<glm::vec3> truth;
    for (const Receiver& r : work.receivers()) truth.push_back(exhaustive_sum(work, r, oracle, sum_scratch));

    const std::vector<std::uint32_t> order = by_place(work);
    const auto shade = [&](const char* name, std::size_t max_cut, const auto& sees, auto& policy,
                           std::size_t group = 0) {
        Row row;
        const lightcuts::LightcutOptions options{
            .max_cut = max_cut, .seed = work.options().seed, .clamp = work.clamp()};
        for (std::size_t k = 0; k < order.size(); ++k) {
            const std::size_t i = order[k];
            const Receiver& receiver = work.receivers()[i];
            if (group > 0 && k % group == 0) {
                row.time += seconds([&] { proofs.start(box_of_group(work, std::span(order).subspan(k), group)); });
            }
            if constexpr (requires { policy.look_from(receiver); }) policy.look_from(receiver);
            lightcuts::CutResult<glm::vec3> result;
            row.time += seconds([&] {
                lightcuts::shade(forest, std::span(&receiver, 1), sees, std::span(&result, 1), scratch, options,
                                 policy);
            });
            row.cut += static_cast<double>(result.cut_size);
            row.rays += static_cast<double>(result.queries);
            row.at_limit += max_cut > 0 && result.cut_size >= max_cut ? 1.0 : 0.0;
            for (int c = 0; c < 3; ++c) {
                row.error.add(static_cast<double>(result.radiance[c]), static_cast<double>(truth[i][c]));
            }
        }
        const auto count = static_cast<double>(work.receivers().size());
        std::printf("  %-28s cut %7.1f  rays %7.1f  at the limit %5.1f %%  relative RMSE %5.2f %%  %8.1f us a point\n",
                    name, row.cut / count, row.rays / count, 100.0 * row.at_limit / count, 100.0 * row.error.relative(),
                    1e6 * row.time / count);
        std::fflush(stdout);
    };
    const lightcuts::TwoStageBounds usual;
    HiddenKnown<Forest> known(forest, oracle);
    shade("limited", limit, oracle, usual);
    shade("without limit", 0, oracle, usual);
    shade("proofs, limited", limit, proving, usual);
    shade("proofs, without limit", 0, proving, usual);
    for (const std::size_t group : {4u, 16u, 64u}) {
        const std::string name = "groups of " + std::to_string(group) + ", limited";
        shade(name.c_str(), limit, sharing, usual, group);
    }
    shade("hidden known, limited", limit, oracle, known);
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string> scenes{"builtin:hall?sun-sky=35,120&indirect=20000&ground=0", "builtin:hall"};
    int width = 20, height = 15;
    std::size_t limit = 1000;
    CLI::App app{"Cuts with proofs that clusters are hidden"};
    app.add_option("scenes", scenes, "files or builtin:NAME, and ?KEY=VALUE&... for their lights");
    app.add_option("--width", width, "of the picture, pixels");
    app.add_option("--height", height, "of the picture, pixels");
    app.add_option("--max-cut", limit, "where cuts are limited");
    CLI11_PARSE(app, argc, argv);
    for (const std::string& scene : scenes) {
        std::printf("%s\n", scene.c_str());
        const Workload work(scene, width, height);
        work.visit([&](const auto& forest) { measure(work, forest, limit); });
    }
    return 0;
}
