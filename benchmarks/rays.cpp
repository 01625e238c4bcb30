/// What it costs that no ray slips between triangles that share an edge: rays and pictures with the scene built
/// robustly, as the renderer does, against the same without. One thread. Prints a table and writes rays.json.

#include <cstdio>
#include <string>
#include <vector>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "figures.hpp"
#include "prepare_scene.hpp"
#include "recording_oracle.hpp"
#include "render_loop.hpp"
#include "shader.hpp"
#include "timing.hpp"
#include "view.hpp"
#include "workload.hpp"

namespace {

using namespace benchmark;

/// One way of building the scene, and its times in each run.
struct Way {
    const render::RayScene& rays;
    std::vector<double> eye, single, stream, picture;
};

struct Row {
    std::string scene;
    std::size_t eye_rays = 0, shadow_rays = 0;
    double fast_eye = 0, fast_single = 0, fast_stream = 0, fast_picture = 0;  ///< seconds, medians
    double eye = 0, single = 0, stream = 0, picture = 0;                      ///< robust / fast, medians over the runs
};

/// Everything that is timed in a scene; the same rays for both ways.
class Contest {
public:
    Contest(const std::string& scene, int width, int height)
        : work_(scene, 96, 72), options_(work_.options()),
          view_(work_.scene().cameras.front(), work_.scene().origin, width, height) {
        options_.quiet = true;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                eye_rays_.push_back(view_.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f));
            }
        }
        const render::OpaqueOracle oracle = work_.oracle();
        const RecordingOracle recording{oracle, record_};
        std::vector<lightcuts::CutResult<glm::vec3>> results(group_size);
        work_.visit([&]<class Forest>(const Forest& forest) {
            lightcuts::scratch_of<Forest> scratch;
            for_each_group(work_.receivers(), [&](std::span<const Receiver> group) {
                lightcuts::shade(forest, group, recording, std::span(results).first(group.size()), scratch,
                                 {.clamp = work_.clamp()});
            });
        });
    }

    Row measure(int runs) const {
        const render::RayScene not_robust(work_.scene(), render::RayTracer(), {.robust = false});
        Way fast{not_robust, {}, {}, {}, {}}, robust{work_.rays(), {}, {}, {}, {}};
        for (int run = 0; run < runs; ++run) {
            // By turns, so that neither is always the one that finds the caches warm.
            time(run % 2 == 0 ? fast : robust);
            time(run % 2 == 0 ? robust : fast);
        }
        const auto ratio = [&](std::vector<double> Way::*times) {
            std::vector<double> ratios;
            for (std::size_t i = 0; i < (fast.*times).size(); ++i) {
                ratios.push_back((robust.*times)[i] / (fast.*times)[i]);
            }
            return median(ratios);
        };
        return {.scene = {},
                .eye_rays = eye_rays_.size(),
                .shadow_rays = record_.queries.size(),
                .fast_eye = median(fast.eye),
                .fast_single = median(fast.single),
                .fast_stream = median(fast.stream),
                .fast_picture = median(fast.picture),
                .eye = ratio(&Way::eye),
                .single = ratio(&Way::single),
                .stream = ratio(&Way::stream),
                .picture = ratio(&Way::picture)};
    }

private:
    void time(Way& way) const {
        std::size_t hits = 0;
        way.eye.push_back(seconds([&] {
            for (const render::EyeRay& ray : eye_rays_) hits += way.rays.nearest(ray.origin, ray.direction) ? 1 : 0;
        }));
        way.single.push_back(seconds([&] {
            for (const lightcuts::VisibilityQuery& q : record_.queries) {
                const glm::vec3 passed = q.distant ? way.rays.to_infinity(q.from, q.to)
                                                   : way.rays.to_point(q.from, q.to);
                hits += passed == glm::vec3(0.0f) ? 1 : 0;
            }
        }));
        std::vector<float> answers(record_.queries.size());
        const render::OpaqueOracle oracle(work_.scene(), way.rays);
        way.stream.push_back(seconds([&] {
            record_.for_each_batch([&](std::size_t first, std::size_t size) {
                oracle.many(std::span(record_.queries).subspan(first, size), std::span(answers).subspan(first, size));
            });
        }));
        if (hits == 0) std::puts("(nothing is hit)");

        const render::EyePathTracer surfaces(work_.scene(), way.rays, render::shade_of(options_));
        const auto shader = render::make_shader(work_.scene(), way.rays, options_);
        way.picture.push_back(seconds([&] { render_picture(view_, surfaces, *shader, options_); }));
    }

    Workload work_;
    render::Options options_;
    render::View view_;
    std::vector<render::EyeRay> eye_rays_;
    RecordedRays record_;
};

nlohmann::json to_json(const Row& r) {
    const auto ns = [](double seconds, std::size_t rays) { return 1e9 * seconds / static_cast<double>(rays); };
    return {{"scene", r.scene},
            {"eye_rays", r.eye_rays},
            {"shadow_rays", r.shadow_rays},
            {"ns_per_eye_ray", {{"fast", ns(r.fast_eye, r.eye_rays)}, {"ratio", r.eye}}},
            {"ns_per_shadow_ray", {{"fast", ns(r.fast_single, r.shadow_rays)}, {"ratio", r.single}}},
            {"ns_per_streamed_ray", {{"fast", ns(r.fast_stream, r.shadow_rays)}, {"ratio", r.stream}}},
            {"seconds_per_picture", {{"fast", r.fast_picture}, {"ratio", r.picture}}}};
}

}  // namespace

int main(int argc, char** argv) {
    int width = 240, height = 180, runs = 15;
    std::vector<std::string> scenes{"builtin:hall",     "builtin:omni",    "builtin:directional",
                                    "builtin:surfaces", "builtin:tableau", "builtin:colonnade"};
    CLI::App app{"Time of rays and pictures with the scene built robustly, over the time without"};
    app.add_option("scenes", scenes, "files or builtin:NAME, and ?KEY=VALUE&... for their lights");
    app.add_option("--width", width, "of the picture, pixels");
    app.add_option("--height", height, "of the picture, pixels");
    app.add_option("--runs", runs, "medians are over this odd number")->check(odd_number());
    CLI11_PARSE(app, argc, argv);
    return write_figures("bench-rays", "rays.json", [&] {
        const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
        nlohmann::json rows = nlohmann::json::array();
        std::printf("%-20s | %-15s | %-15s | %-15s | %-15s |\n", "", "eye rays", "shadow rays", "... in streams",
                    "picture");
        std::printf("%-20s |", "scene");
        for (const char* unit : {"ns", "ns", "ns", "s"}) std::printf(" %7s   ratio |", unit);
        std::printf("\n");
        for (const std::string& name : scenes) {
            Row r = Contest(name, width, height).measure(runs);
            r.scene = name;
            const nlohmann::json row = to_json(r);
            std::printf("%-20s |", name.c_str());
            for (const char* key : {"ns_per_eye_ray", "ns_per_shadow_ray", "ns_per_streamed_ray"}) {
                std::printf(" %7.1f %7.3f |", row[key]["fast"].get<double>(), row[key]["ratio"].get<double>());
            }
            std::printf(" %7.3f %7.3f |\n", r.fast_picture, r.picture);
            std::fflush(stdout);
            rows.push_back(row);
        }
        return rows;
    });
}
