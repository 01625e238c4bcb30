/// Time of lightcuts against the time of tracing the same shadow rays one by one, and against the exhaustive sum.
/// One thread. Prints a table and writes lightcut.json.

#include <cstdio>
#include <cstring>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "figures.hpp"
#include "recording_oracle.hpp"
#include "timing.hpp"
#include "workload.hpp"

namespace {

using namespace benchmark;
using lightcuts::CutResult;
using lightcuts::VisibilityQuery;

/// Counts the bounds that a policy is asked for.
struct CountingBounds : lightcuts::TwoStageBounds {
    mutable std::uint64_t* quick_calls;
    mutable std::uint64_t* tight_calls;

    template <class M, class C, class S>
    void quick_many(const M& material, const C* const* clusters, std::size_t count, const lightcuts::Box& receivers,
                    S* units) const {
        *quick_calls += count;
        TwoStageBounds::quick_many(material, clusters, count, receivers, units);
    }
    template <class M, class C>
    auto tight(const M& material, const C& cluster, const lightcuts::Box& receivers) const {
        ++*tight_calls;
        return TwoStageBounds::tight(material, cluster, receivers);
    }
};

struct Row {
    std::string scene;
    std::size_t lights = 0;
    std::size_t receivers = 0;
    double cut_size = 0, rays = 0, quick_bounds = 0, tight_bounds = 0;
    double seconds = 0, ratio = 0, stream_ratio = 0, ns_per_ray = 0, ns_per_node_outside = 0;
    double exhaustive_seconds = 0, exhaustive_ratio = 0;
};

struct Sums {
    std::uint64_t nodes = 0;
    std::uint64_t queries = 0;
};

template <class Oracle, class Policy = lightcuts::TwoStageBounds>
Sums shade_all(const Workload& work, const Oracle& oracle, const Policy& policy = {}) {
    static std::vector<CutResult<glm::vec3>> results(group_size);
    Sums sums;
    work.visit([&]<class Forest>(const Forest& forest) {
        static lightcuts::scratch_of<Forest> scratch;
        for_each_group(work.receivers(), [&](std::span<const Receiver> group) {
            const auto out = std::span(results).first(group.size());
            lightcuts::shade(forest, group, oracle, out, scratch, {.clamp = work.clamp()}, policy);
            for (const auto& r : out) {
                sums.nodes += r.cut_size;
                sums.queries += r.queries;
            }
        });
    });
    return sums;
}

Row measure(const std::string& scene, int width, int height, int runs, std::size_t exhaustive_receivers) {
    const Workload work(scene, width, height);
    const render::OpaqueOracle oracle = work.oracle();
    Row row;
    row.scene = scene;
    row.lights = work.light_count();
    row.receivers = work.receivers().size();
    const auto count = static_cast<double>(row.receivers);

    RecordedRays record;
    std::uint64_t quick_calls = 0, tight_calls = 0;
    CountingBounds counting;
    counting.quick_calls = &quick_calls;
    counting.tight_calls = &tight_calls;
    const Sums sums = shade_all(work, RecordingOracle{oracle, record}, counting);
    row.cut_size = static_cast<double>(sums.nodes) / count;
    row.rays = static_cast<double>(sums.queries) / count;
    row.quick_bounds = static_cast<double>(quick_calls) / count;
    row.tight_bounds = static_cast<double>(tight_calls) / count;

    const std::vector<VisibilityQuery>& queries = record.queries;
    std::vector<RTCRay> rays(queries.size());
    const auto set_up = [&] {
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const VisibilityQuery& q = queries[i];
            const glm::vec3 d = q.distant ? q.to : q.to - q.from;
            rays[i] = {q.from.x, q.from.y, q.from.z,
                       0.0f,     d.x,      d.y,
                       d.z,      0.0f,     q.distant ? std::numeric_limits<float>::infinity() : 1.0f - 1e-4f,
                       ~0u,      0u,       0u};
        }
    };
    std::vector<float> answers(queries.size());
    std::vector<double> cut_times, ratios, stream_ratios;
    for (int run = 0; run < runs; ++run) {
        const double cut = seconds([&] { shade_all(work, oracle); });
        set_up();
        const double replay = seconds([&] {
            for (RTCRay& ray : rays) {
                RTCIntersectContext context;
                rtcInitIntersectContext(&context);
                rtcOccluded1(work.embree_scene(), &context, &ray);
            }
        });
        const double stream = seconds([&] {
            record.for_each_batch([&](std::size_t first, std::size_t size) {
                oracle.many(std::span(queries).subspan(first, size), std::span(answers).subspan(first, size));
            });
        });
        cut_times.push_back(cut);
        ratios.push_back(cut / replay);
        stream_ratios.push_back(stream / replay);
    }
    row.seconds = median(cut_times);
    row.ratio = median(ratios);
    row.stream_ratio = median(stream_ratios);
    row.ns_per_ray = row.seconds * 1e9 / static_cast<double>(sums.queries);
    row.ns_per_node_outside = row.seconds * (1.0 - row.stream_ratio / row.ratio) * 1e9 /
                              static_cast<double>(sums.nodes);

    if (exhaustive_receivers > 0) {
        lightcuts::EstimateScratch<glm::vec3> scratch;
        const std::size_t stride = std::max<std::size_t>(1, row.receivers / exhaustive_receivers);
        std::size_t shaded = 0;
        row.exhaustive_seconds = seconds([&] {
            for (std::size_t i = 0; i < row.receivers; i += stride, ++shaded) {
                exhaustive_sum(work, work.receivers()[i], oracle, scratch);
            }
        });
        row.exhaustive_seconds *= count / static_cast<double>(shaded);
        row.exhaustive_ratio = row.exhaustive_seconds / row.seconds;
    }
    return row;
}

nlohmann::json to_json(const Row& r) {
    return {{"scene", r.scene},
            {"lights", r.lights},
            {"receivers", r.receivers},
            {"cut_size", r.cut_size},
            {"shadow_rays", r.rays},
            {"quick_bounds", r.quick_bounds},
            {"tight_bounds", r.tight_bounds},
            {"seconds", r.seconds},
            {"time_over_own_rays", r.ratio},
            {"streams_over_own_rays", r.stream_ratio},
            {"ns_per_ray", r.ns_per_ray},
            {"ns_per_node_outside_rays", r.ns_per_node_outside},
            {"exhaustive_seconds", r.exhaustive_seconds},
            {"exhaustive_over_lightcuts", r.exhaustive_ratio}};
}

}  // namespace

int main(int argc, char** argv) {
    std::string only;
    int width = 96, height = 72, runs = 3;
    std::size_t exhaustive_receivers = 30;
    std::vector<std::string> scenes{"builtin:hall?area-points=1",
                                    "builtin:hall?area-points=4",
                                    "builtin:hall?area-points=8",
                                    "builtin:hall?area-points=16",
                                    "builtin:hall?area-points=64",
                                    "builtin:hall?area-points=256",
                                    "builtin:hall?area-points=1024",
                                    "builtin:hall?area-points=4096",
                                    "builtin:hall?area-points=64&indirect=100000",
                                    "builtin:omni?lights=3000",
                                    "builtin:omni?lights=30000",
                                    "builtin:omni?lights=300000",
                                    "builtin:directional?lights=3000",
                                    "builtin:directional?lights=30000",
                                    "builtin:directional?lights=300000",
                                    "builtin:surfaces?lights=3000",
                                    "builtin:surfaces?lights=30000",
                                    "builtin:surfaces?lights=300000",
                                    "builtin:surfaces?lights=30000&rotated=0"};
    CLI::App app{"Time of lightcuts against the time of tracing the same shadow rays"};
    app.add_option("scenes", scenes, "files or builtin:NAME, and ?KEY=VALUE&... for their lights");
    app.add_option("--only", only, "measure only scenes whose name contains this");
    app.add_option("--width", width, "of the picture, pixels");
    app.add_option("--height", height, "of the picture, pixels");
    app.add_option("--runs", runs, "medians are over this odd number")->check(odd_number());
    app.add_option("--exhaustive", exhaustive_receivers, "points for the exhaustive sum; 0: none");
    CLI11_PARSE(app, argc, argv);
    return write_figures("bench-lightcut", "lightcut.json", [&] {
        nlohmann::json rows = nlohmann::json::array();
        std::printf("%-44s %8s %7s %7s %7s %7s %7s %7s %8s %8s %9s\n", "scene", "lights", "cut", "rays", "quick",
                    "tight", "/rays", "stream", "ns/ray", "ns/node", "/exhaust.");
        for (const std::string& name : scenes) {
            if (name.find(only) == std::string::npos) continue;
            const Row r = measure(name, width, height, runs, exhaustive_receivers);
            std::printf("%-44s %8zu %7.1f %7.1f %7.1f %7.1f %7.3f %7.3f %8.0f %8.0f %9.2f\n", name.c_str(), r.lights,
                        r.cut_size, r.rays, r.quick_bounds, r.tight_bounds, r.ratio, r.stream_ratio, r.ns_per_ray,
                        r.ns_per_node_outside, r.exhaustive_ratio);
            std::fflush(stdout);
            rows.push_back(to_json(r));
        }
        return rows;
    });
}
