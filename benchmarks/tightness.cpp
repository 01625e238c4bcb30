/// Size of cuts by the library's bounds over that by exact ones: what tighter bounds could still save. Prints a table
/// and writes tightness.json.

#include <array>
#include <cstdio>
#include <exception>
#include <fstream>
#include <limits>
#include <type_traits>

#include <CLI/CLI.hpp>
#include <glm/common.hpp>
#include <lightcuts/material/terms.hpp>
#include <nlohmann/json.hpp>

#include "workload.hpp"

namespace {

using namespace benchmark;

/// Bounds that no valid ones can beat: the largest terms that any light of the cluster has at the receiver.
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
                                 ? lightcuts::unshadowed_terms(receiver, tree.lights()[topology.item(n)])
                                 : glm::max(largest[topology.left(n)], largest[topology.right(n)]);
            }
        });
    }

    template <class M, class C>
    glm::vec3 quick(const M&, const C& cluster, const glm::vec3&) const {
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

/// Cut sizes, averaged over receivers.
struct Row {
    std::string scene;
    std::size_t lights = 0, receivers = 0;
    double exact = 0, usual = 0, tight = 0, separate = 0;
    double median_ratio = 0;  ///< of usual / exact over the receivers
};

template <class Forest>
Row measure(const Workload& work, const Forest& forest, std::size_t max_cut) {
    const render::OpaqueOracle oracle = work.oracle();
    const lightcuts::LightcutOptions options{.max_cut = max_cut, .clamp = work.clamp()};
    lightcuts::scratch_of<Forest> scratch;
    const auto cut_size = [&](const Receiver& receiver, const auto& policy) {
        lightcuts::CutResult<glm::vec3> result;
        lightcuts::shade(forest, std::span(&receiver, 1), oracle, std::span(&result, 1), scratch, options, policy);
        return static_cast<double>(result.cut_size);
    };
    Row row;
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
        row.tight += cut_size(receiver, lightcuts::TwoStageBounds{.doubt = std::numeric_limits<double>::max()}) / count;
        row.separate += cut_size(receiver, lightcuts::SeparateBounds{}) / count;
        ratios.push_back(ours / least);
    }
    row.median_ratio = median(ratios);
    return row;
}

Row measure(const std::string& scene, int width, int height, std::size_t max_cut) {
    const Workload work(scene, width, height);
    Row row = work.visit([&](const auto& forest) { return measure(work, forest, max_cut); });
    row.scene = scene;
    return row;
}

nlohmann::json to_json(const Row& r) {
    return {{"scene", r.scene},
            {"lights", r.lights},
            {"receivers", r.receivers},
            {"cut_size_exact", r.exact},
            {"cut_size_default", r.usual},
            {"cut_size_tight", r.tight},
            {"cut_size_separate", r.separate},
            {"default_over_exact", r.usual / r.exact},
            {"default_over_exact_median", r.median_ratio},
            {"tight_over_exact", r.tight / r.exact},
            {"separate_over_exact", r.separate / r.exact}};
}

}  // namespace

int main(int argc, char** argv) {
    std::string only;
    int width = 40, height = 30;
    std::size_t max_cut = 0;
    std::vector<std::string> scenes{"builtin:hall?area-points=64",
                                    "builtin:hall?area-points=64&indirect=100000",
                                    "builtin:omni?lights=10000",
                                    "builtin:directional?lights=10000",
                                    "builtin:surfaces?lights=10000&rotated=0",
                                    "builtin:surfaces?lights=10000"};
    CLI::App app{"Size of cuts by the library's bounds over that by exact ones"};
    app.add_option("scenes", scenes, "files or builtin:NAME, and ?KEY=VALUE&... for their lights");
    app.add_option("--only", only, "measure only scenes whose name contains this");
    app.add_option("--width", width, "of the picture, pixels");
    app.add_option("--height", height, "of the picture, pixels");
    app.add_option("--max-cut", max_cut, "most clusters in a cut; 0: unlimited");
    CLI11_PARSE(app, argc, argv);
    try {
        nlohmann::json rows = nlohmann::json::array();
        std::printf("%-44s %7s %6s | %7s | %7s %7s %8s | %8s %8s %8s | %8s\n", "mean cut size by bounds", "lights",
                    "points", "exact", "default", "tight", "separate", "/exact", "/exact", "/exact", "median");
        for (const std::string& name : scenes) {
            if (name.find(only) == std::string::npos) continue;
            const Row r = measure(name, width, height, max_cut);
            std::printf("%-44s %7zu %6zu | %7.1f | %7.1f %7.1f %8.1f | %8.3f %8.3f %8.3f | %8.3f\n", name.c_str(),
                        r.lights, r.receivers, r.exact, r.usual, r.tight, r.separate, r.usual / r.exact,
                        r.tight / r.exact, r.separate / r.exact, r.median_ratio);
            std::fflush(stdout);
            rows.push_back(to_json(r));
        }
        std::ofstream("tightness.json") << rows.dump(2) << "\n";
    } catch (const std::exception& e) {
        std::fprintf(stderr, "bench-tightness: %s\n", e.what());
        return 1;
    }
}
