#include "report/measurement.hpp"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <memory>

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include "adaptation.hpp"
#include "moving_view.hpp"
#include "prepare_scene.hpp"
#include "rays/ray_scene.hpp"
#include "render_loop.hpp"
#include "shader.hpp"
#include "surfaces/surface.hpp"
#include "timing.hpp"
#include "view.hpp"
#include "workload.hpp"

namespace benchmark {

namespace {

/// Longer runs vary little, and would take minutes.
constexpr double long_run = 2.0;

/// Passes points on to a method and adds up the processor time that it takes, on all threads.
class TimedShader final : public render::Shader {
public:
    explicit TimedShader(const render::Shader& method) : method_(method) {}

    std::unique_ptr<Scratch> make_scratch() const override { return method_.make_scratch(); }

    void shade(std::span<const render::SurfacePoint> points, std::span<render::Shading> out,
               Scratch& scratch) const override {
        const double start = processor_seconds();
        method_.shade(points, out, scratch);
        nanoseconds_ += static_cast<std::int64_t>(1e9 * (processor_seconds() - start));
    }

    bool shades_pixels() const override { return method_.shades_pixels(); }

    render::Shading shade_pixel(std::span<const render::SurfacePoint> points, float share,
                                Scratch& scratch) const override {
        const double start = processor_seconds();
        const render::Shading shading = method_.shade_pixel(points, share, scratch);
        nanoseconds_ += static_cast<std::int64_t>(1e9 * (processor_seconds() - start));
        return shading;
    }

    double seconds() const { return 1e-9 * static_cast<double>(nanoseconds_.load()); }

private:
    const render::Shader& method_;
    mutable std::atomic<std::int64_t> nanoseconds_{0};
};

/// No light at all.
class BlackShader final : public render::Shader {
public:
    std::unique_ptr<Scratch> make_scratch() const override { return std::make_unique<Scratch>(); }
    void shade(std::span<const render::SurfacePoint>, std::span<render::Shading> out, Scratch&) const override {
        std::fill(out.begin(), out.end(), render::Shading{});
    }
};

/// Processor seconds of all threads.
double process_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

class SceneRenderer {
public:
    SceneRenderer(const ReportScene& scene, const MeasurementOptions& options)
        : scene_(*scene.scene), runs_(options.runs), rays_(scene_),
          view_(scene.camera, scene_, scene.width, scene.height, render::lens_of(scene.options, scene.camera)),
          surfaces_(scene_, rays_, render::shade_of(scene.options)), usual_(scene.options) {
        emitted_ = render::render_picture(view_, surfaces_, BlackShader(), usual_).picture;
        for (render::Material& material : scene_.materials) material.emission = glm::vec3(0.0f);
        scene_.background = {};
        usual_.aovs = {"cut_size"};
    }

    const render::Picture& emitted() const { return emitted_; }

    /// As the renderer would be without options but the scene's.
    render::Options usual() const { return usual_; }

    Measurement run(const render::Options& options) const {
        Measurement result;
        const double start = process_seconds();
        const auto shader = render::make_shader(scene_, rays_, options);
        shader->adapt(options.adaptation ? *options.adaptation : render::measure_adaptation(view_, surfaces_, *shader));
        result.prepare_seconds = process_seconds() - start;
        std::vector<double> times;
        do {
            const TimedShader timed(*shader);
            render::Rendering rendering = render::render_picture(view_, surfaces_, timed, options);
            times.push_back(timed.seconds());
            const render::RenderStatistics& s = rendering.statistics;
            result.rays_per_pixel = static_cast<double>(s.shadow_rays) / static_cast<double>(s.pixels);
            if (s.cuts > 0) result.cut_size = static_cast<double>(s.cut_nodes) / static_cast<double>(s.cuts);
            result.picture = std::move(rendering.picture);
        } while (static_cast<int>(times.size()) < runs_ && times.back() < long_run);
        result.runs = static_cast<int>(times.size());
        result.seconds = median(times);
        return result;
    }

private:
    render::Scene scene_;  ///< emitters and background are black once `emitted_` is rendered
    int runs_;
    render::RayScene rays_;
    render::MovingView view_;
    render::EyePathTracer surfaces_;
    render::Options usual_;
    render::Picture emitted_;
};

/// True if clamping makes another picture of the scene.
bool has_two_references(const ReportScene& scene) {
    return scene.scene->virtual_count() > 0 && scene.options.clamp.has_threshold();
}

std::vector<double> values_of(const ReportMethod& method, const MeasurementOptions& options) {
    std::vector<double> values;
    const std::size_t step = options.quick && method.values.size() > 1 ? 2 : 1;
    for (std::size_t i = step - 1; i < method.values.size(); i += step) values.push_back(method.values[i]);
    return values;
}

}  // namespace

const Measurement& SceneMeasurement::reference_of(const ReportMethod& method) const {
    render::Options options = scene.options;
    options.method = method.method;
    return unclamped && !options.clamping().has_threshold() ? *unclamped : exhaustive;
}

std::size_t setting_count(const ReportScene& scene, const MeasurementOptions& options) {
    std::size_t count = has_two_references(scene) ? 2 : 1;
    for (const ReportMethod* method : report_methods(scene.options)) count += values_of(*method, options).size();
    return count;
}

SceneMeasurement measure(const ReportScene& scene, const MeasurementOptions& options,
                         const std::function<void(const std::string&)>& start) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(options.threads));
    tbb::task_arena arena(options.threads);
    SceneMeasurement result;
    result.scene = scene;
    arena.execute([&] {
        const SceneRenderer renderer(scene, options);
        result.emitted = renderer.emitted();
        start("exhaustive");
        render::Options exhaustive = renderer.usual();
        exhaustive.method = "exhaustive";
        result.exhaustive = renderer.run(exhaustive);
        if (has_two_references(scene)) {
            start("exhaustive, not clamped");
            exhaustive.clamp = {};
            result.unclamped = renderer.run(exhaustive);
        }
        for (const ReportMethod* method : report_methods(scene.options)) {
            Curve& curve = result.curves.emplace_back();
            curve.method = method;
            for (const double value : values_of(*method, options)) {
                start(std::string(method->name) + ", " + method->parameter + " " + as_text(value));
                render::Options chosen = renderer.usual();
                chosen.method = method->method;
                method->set(chosen, value);
                Measurement& point = curve.points.emplace_back(renderer.run(chosen));
                point.value = value;
                point.error = render::compare(point.picture, result.reference_of(*method).picture);
            }
        }
    });
    return result;
}

std::string as_text(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

}  // namespace benchmark
