/// What it is worth to know that whole clusters are hidden: cuts, rays, time and error without that knowledge, limited
/// and not; with what `HiddenLights` proves, at each point and for groups of them; with what is learned; and with all
/// of it. Processor time of one thread.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <CLI/CLI.hpp>
#include <glm/vec3.hpp>
#include <lightcuts/bound/policy.hpp>
#include <lightcuts/cut/learned_visibility.hpp>
#include <lightcuts/cut/shade_in_groups.hpp>

#include "coarse_picture.hpp"
#include "error_sum.hpp"
#include "figures.hpp"
#include "rays/scene_proofs.hpp"
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

/// The receivers of a coarse picture, as the renderer takes them to learn from.
std::vector<Receiver> pilots_of(const Workload& work, int width, int height) {
    const render::CoarseGrid grid = render::pilot_grid(width, height);
    std::vector<Receiver> pilots;
    for (const render::SurfacePoint& p : points_seen(work.scene(), work.rays(), grid.columns, grid.rows)) {
        pilots.push_back(
            {p.position, render::SurfaceMaterial(p), p.ray_origin, static_cast<std::uint32_t>(pilots.size())});
    }
    return pilots;
}

struct Row {
    double cut = 0, rays = 0, at_limit = 0;
    ErrorSum error;
};

/// `width` x `height`: of the picture that the rays of pilots are shared out to.
template <class Forest>
void measure(const Workload& work, const Forest& forest, std::size_t limit, int width, int height) {
    const render::OpaqueOracle oracle = work.oracle();
    std::optional<render::SceneProofs> proofs;
    const double set_up = seconds([&] { proofs.emplace(work.scene(), work.rays()); });
    const lightcuts::OccluderMesh& mesh = proofs->mesh();
    std::printf("  %zu triangles, %.1f bytes each, set up in %.3f s; %zu lights, %zu points\n", mesh.size(),
                static_cast<double>(mesh.memory_bytes()) / static_cast<double>(std::max<std::size_t>(mesh.size(), 1)),
                set_up, work.light_count(), work.receivers().size());
    lightcuts::EstimateScratch<glm::vec3> sum_scratch;
    std::vector<glm::vec3> truth;
    for (const Receiver& r : work.receivers()) truth.push_back(exhaustive_sum(work, r, oracle, sum_scratch));

    const std::span<const Receiver> all(work.receivers());
    std::vector<lightcuts::CutResult<glm::vec3>> results(all.size());
    lightcuts::GroupScratch<Forest, Receiver> scratch;
    const auto options_of = [&](std::size_t max_cut) {
        return lightcuts::LightcutOptions{.max_cut = max_cut, .seed = work.options().seed, .clamp = work.clamp()};
    };
    const auto print = [&](const std::string& name, double time) {
        Row row;
        for (std::size_t i = 0; i < results.size(); ++i) {
            row.cut += static_cast<double>(results[i].cut_size);
            row.rays += static_cast<double>(results[i].queries);
            row.at_limit += results[i].stop == lightcuts::StopReason::limit ? 1.0 : 0.0;
            for (int c = 0; c < 3; ++c) {
                row.error.add(static_cast<double>(results[i].radiance[c]), static_cast<double>(truth[i][c]));
            }
        }
        const auto count = static_cast<double>(results.size());
        std::printf("  %-28s cut %7.1f  rays %7.1f  at the limit %5.1f %%  relative RMSE %5.2f %%  %8.1f us a point\n",
                    name.c_str(), row.cut / count, row.rays / count, 100.0 * row.at_limit / count,
                    100.0 * row.error.relative(), 1e6 * time / count);
        std::fflush(stdout);
    };
    // Receivers are shaded by tiles, as a renderer has them.
    const std::size_t tile = 512;
    const auto by_tiles = [&](auto&& shade) {
        double time = 0.0;
        for (std::size_t first = 0; first < all.size(); first += tile) {
            const std::size_t count = std::min(tile, all.size() - first);
            time += seconds([&] { shade(all.subspan(first, count), std::span(results).subspan(first, count)); });
        }
        return time;
    };
    const auto alone = [&](const char* name, std::size_t max_cut, const auto& sees) {
        print(name, by_tiles([&](auto receivers, auto out) {
                  for (std::size_t i = 0; i < receivers.size(); i += 16) {
                      const std::size_t count = std::min<std::size_t>(16, receivers.size() - i);
                      lightcuts::shade(forest, receivers.subspan(i, count), sees, out.subspan(i, count), scratch.cuts,
                                       options_of(max_cut));
                  }
              }));
    };
    const auto proving = [&](const std::string& name, std::size_t max_cut, const lightcuts::GroupOptions& groups) {
        print(name, by_tiles([&](auto receivers, auto out) {
                  lightcuts::shade_in_groups(forest, receivers, oracle, proofs->hidden(), out, scratch,
                                             options_of(max_cut), groups);
              }));
    };
    alone("limited", limit, oracle);
    alone("without limit", 0, oracle);
    proving("own proofs, limited", limit, {.largest_group = 1});
    proving("own proofs, without limit", 0, {.largest_group = 1});
    for (const std::size_t group : {16u, 64u, 256u}) {
        const std::string name = "groups of " + std::to_string(group);
        proving(name + ", limited", limit, {.largest_group = group, .own_proofs_at_limit = false});
        proving(name + ", own at the limit", limit, {.largest_group = group});
    }
    const std::vector<Receiver> pilots = pilots_of(work, width, height);
    const lightcuts::LearningOptions learning{
        .cut = {.max_cut = limit, .seed = work.options().seed, .clamp = work.clamp()}};
    lightcuts::LearnedVisibility learned;
    const double learning_time = seconds(
        [&] { learned = lightcuts::LearnedVisibility(forest, std::span<const Receiver>(pilots), oracle, learning); });
    const double pixels = static_cast<double>(width) * static_cast<double>(height);
    std::printf("  %zu pilots: %.1f rays and %.1f us more for each of %dx%d points\n", pilots.size(),
                static_cast<double>(learned.rays()) / pixels, 1e6 * learning_time / pixels, width, height);
    const lightcuts::LearnedOracle likely(oracle, learned);
    alone("learned, limited", limit, likely);
    HiddenKnown<Forest> known(forest, oracle);
    print("hidden known, limited", by_tiles([&](auto receivers, auto out) {
              for (std::size_t i = 0; i < receivers.size(); ++i) {
                  known.look_from(receivers[i]);
                  out[i] = lightcuts::shade(forest, receivers[i], oracle, scratch.cuts, options_of(limit), known);
              }
          }));
}

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string> scenes{"builtin:hall?sun-sky=35,120&indirect=20000&ground=0", "builtin:hall"};
    int width = 20, height = 15;
    int picture_width = 320, picture_height = 180;
    std::size_t limit = 1000;
    CLI::App app{"Cuts with proofs that clusters are hidden"};
    app.add_option("scenes", scenes, "files or builtin:NAME, and ?KEY=VALUE&... for their lights");
    app.add_option("--width", width, "of the picture, pixels");
    app.add_option("--height", height, "of the picture, pixels");
    app.add_option("--picture-width", picture_width, "of the picture that shares what is learned, pixels");
    app.add_option("--picture-height", picture_height, "of that picture, pixels");
    app.add_option("--max-cut", limit, "where cuts are limited");
    CLI11_PARSE(app, argc, argv);
    for (const std::string& scene : scenes) {
        std::printf("%s\n", scene.c_str());
        const Workload work(scene, width, height);
        work.visit([&](const auto& forest) { measure(work, forest, limit, picture_width, picture_height); });
    }
    return 0;
}
