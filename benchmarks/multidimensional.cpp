/// What a pixel of many eye rays costs: multidimensional lightcuts beside an independent lightcut for each gather
/// point, the unified cut, sampling, and eye rays alone, over numbers of eye rays [Multidimensional Lightcuts 2006,
/// Fig. 4 and 7]. Processor time of one thread, medians of runs by turns.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <lightcuts/core/invalid_input.hpp>
#include <lightcuts/product/gather_forest.hpp>

#include "adaptation.hpp"
#include "figures.hpp"
#include "io/output_file.hpp"
#include "moving_view.hpp"
#include "pixel_filter.hpp"
#include "prepare_scene.hpp"
#include "prepared_scene.hpp"
#include "rays/ray_scene.hpp"
#include "report/plot.hpp"
#include "scene_options.hpp"
#include "shader.hpp"
#include "surfaces/gather_lobes.hpp"
#include "timing.hpp"
#include "view.hpp"

namespace {

using namespace benchmark;

struct Arguments {
    std::vector<std::string> scenes{"builtin:hall"};
    std::vector<int> eye_rays{1, 4, 16, 64, 256};
    int width = 640;
    int height = 480;
    int pixels = 192;  ///< that are shaded, about, spread evenly over the picture
    int runs = 3;
    int reference_rays = 0;  ///< errors are told up to so many eye rays
    bool alone = false;
    std::filesystem::path plots;
};

/// A method, and what it has cost.
struct Method {
    const char* name;
    const char* method;
    std::uint32_t samples;
    std::unique_ptr<render::Shader> shader{};
    std::unique_ptr<render::Shader::Scratch> scratch{};
    std::vector<double> seconds{};
    std::vector<glm::dvec3> pixels{};
    double cut = 0;
    double rays = 0;
};

/// As [Multidimensional Lightcuts 2006, Fig. 7]: what pixels cost over the number of their gather points.
struct Plots {
    Plot milliseconds;
    Plot clusters;

    void add(const std::string& curve, double points, double time, double cut, int eye_rays) {
        const std::string label = std::to_string(eye_rays);
        to(milliseconds, curve).points.push_back({points, time, label});
        if (cut > 0.0) to(clusters, curve).points.push_back({points, cut, label});
    }

private:
    static PlotCurve& to(Plot& plot, const std::string& name) {
        for (PlotCurve& curve : plot.curves) {
            if (curve.name == name) return curve;
        }
        return plot.curves.emplace_back(PlotCurve{name, {}});
    }
};

class Contest {
public:
    Contest(const std::string& name, const Arguments& arguments)
        : arguments_(arguments), options_(scene_options(name)), scene_(make_scene(name)), rays_(scene_),
          tracer_(scene_, rays_, render::shade_of(options_)), filter_(options_.filter),
          view_(scene_.cameras.front(), scene_, arguments.width, arguments.height,
                render::lens_of(options_, scene_.cameras.front())) {
        plots_.milliseconds = {name, "gather points a pixel", "milliseconds a pixel", {}, {}, 1e-9, false};
        plots_.clusters = {name, "gather points a pixel", "clusters or pairs on the cuts", {}, {}, 1e-9, false};
    }

    const render::Scene& scene() const { return scene_; }
    const Plots& plots() const { return plots_; }

    void print(int eye_rays) {
        options_.spp = eye_rays;
        scene_.fog.points_per_ray = render::fog_points_per_ray(eye_rays);
        find_points(eye_rays);
        std::vector<Method> methods;
        methods.push_back({"multidimensional", "multidimensional", 0});
        if (!arguments_.alone) methods.push_back({"unified cut", "unified-cut", 0});
        if (!sums_pixels_only()) {
            methods.push_back({"lightcut a point", "lightcuts", 0});
            methods.push_back({"stochastic, 1 a point", "stochastic-lightcuts", 1});
            methods.push_back({"stochastic, 4 a point", "stochastic-lightcuts", 4});
        }
        const bool with_errors = eye_rays <= arguments_.reference_rays && !sums_pixels_only();
        if (with_errors) methods.push_back({"exhaustive", "exhaustive", 0});
        for (Method& m : methods) prepare(m);
        for (int run = 0; run < arguments_.runs; ++run) {
            for (Method& m : methods) {
                if (std::string(m.method) == "exhaustive" && run > 0) continue;
                m.seconds.push_back(seconds([&] { shade(m, eye_rays); }));
            }
        }
        const double count = static_cast<double>(first_.size() - 1);
        const double trees = tree_seconds();
        plots_.add("eye rays alone", lobes_ / count, 1e3 * eye_seconds_ / count, 0.0, eye_rays);
        std::printf(
            "%4d eye rays a pixel: %.1f gather points, %.3g pairs; eye rays %.3f ms, gather points and trees %.3f ms\n",
            eye_rays, lobes_ / count, lobes_ / count * static_cast<double>(scene_.light_count()),
            1e3 * eye_seconds_ / count, 1e3 * trees / count);
        for (Method& m : methods) {
            std::printf("     %-22s %9.3f ms a pixel %9.1f shadow rays %9.1f clusters", m.name,
                        1e3 * middle(m.seconds) / count, m.rays / count, m.cut / count);
            plots_.add(m.name, lobes_ / count, 1e3 * middle(m.seconds) / count, m.cut / count, eye_rays);
            if (with_errors) std::printf("  relative RMSE %6.2f %%", 100.0 * error(m, methods.back()));
            std::printf("\n");
        }
        std::fflush(stdout);
    }

private:
    render::Scene make_scene(const std::string& name) {
        // Methods clamp virtual lights in different ways, or not at all.
        if (arguments_.reference_rays > 0) options_.clamp = {};
        // Lights may move; methods that cannot follow them are left out.
        options_.method = "multidimensional";
        if (!options_.is_given("--max-cut")) {
            options_.given.push_back("--max-cut");
            options_.max_cut = 2000;
        }
        return lit_scene(name, options_);
    }
    bool sums_pixels_only() const { return arguments_.alone || scene_.at_instants.count() > 0; }

    void find_points(int eye_rays) {
        points_.clear();
        first_.assign(1, 0);
        eye_seconds_ = seconds([&] {
            const double area = static_cast<double>(view_.width()) * view_.height();
            const int stride = std::max(1, static_cast<int>(std::lround(std::sqrt(area / arguments_.pixels))));
            for (int y = stride / 2; y < view_.height(); y += stride) {
                for (int x = stride / 2; x < view_.width(); x += stride) {
                    for (int sample = 0; sample < eye_rays; ++sample) cast(x, y, sample, eye_rays);
                    first_.push_back(points_.size());
                }
            }
        });
    }

    void cast(int x, int y, int sample, int eye_rays) {
        const auto pixel = static_cast<std::uint32_t>(y * view_.width() + x);
        const std::uint32_t instant = render::instant_of_ray(1, pixel, static_cast<std::uint32_t>(sample),
                                                             static_cast<std::uint32_t>(eye_rays), view_.instants());
        const render::LensSample at = render::lens_sample(1, pixel, sample, eye_rays);
        const glm::vec2 offset = filter_(at.offset);
        render::EyeRay ray = view_.at(instant).ray(static_cast<float>(x) + offset.x, static_cast<float>(y) + offset.y,
                                                   at.lens);
        ray.instant = instant;
        tracer_.follow(ray, pixel, static_cast<std::uint32_t>(sample), points_);
    }

    std::span<const render::SurfacePoint> points_of(std::size_t pixel) const {
        return std::span(points_).subspan(first_[pixel], first_[pixel + 1] - first_[pixel]);
    }

    /// Of gather points and of their trees alone; counts the gather points, too.
    double tree_seconds() {
        render::GatherPoints lobes;
        lightcuts::GatherForest<render::DiffuseGatherPoint, render::GlossyGatherPoint, render::FogGatherPoint> trees;
        std::vector<double> times;
        for (int run = 0; run < arguments_.runs; ++run) {
            lobes_ = 0;
            times.push_back(seconds([&] {
                for (std::size_t pixel = 0; pixel + 1 < first_.size(); ++pixel) {
                    lobes.clear();
                    for (const render::SurfacePoint& p : points_of(pixel)) lobes.add(p, 1.0f, 0);
                    lightcuts::GatherTreeOptions tree;
                    if (scene_.at_instants.count() > 0) {
                        tree.instants = static_cast<std::uint32_t>(scene_.instants.size());
                    }
                    trees.build(lobes.diffuse, lobes.glossy, lobes.fog, tree);
                    lobes_ += static_cast<double>(lobes.diffuse.size() + lobes.glossy.size() + lobes.fog.size());
                }
            }));
        }
        return middle(times);
    }

    void prepare(Method& m) const {
        render::Options options = options_;
        options.method = m.method;
        if (m.samples > 0) options.samples = m.samples;
        m.shader = render::make_shader(scene_, rays_, options);
        const auto adaptation = [&] { return render::measure_adaptation(view_, tracer_, *m.shader); };
        m.shader->adapt(options.adaptation ? *options.adaptation : adaptation());
        m.scratch = m.shader->make_scratch();
    }

    void shade(Method& m, int eye_rays) const {
        m.pixels.clear();
        m.cut = m.rays = 0;
        std::vector<render::Shading> shadings;
        for (std::size_t pixel = 0; pixel + 1 < first_.size(); ++pixel) {
            const auto points = points_of(pixel);
            glm::dvec3 sum(0.0);
            const auto count = [&](const render::Shading& s) {
                m.cut += static_cast<double>(s.cut_size);
                m.rays += static_cast<double>(s.shadow_rays);
            };
            if (m.shader->shades_pixels()) {
                const render::Shading s = m.shader->shade_pixel(points, 1.0f / static_cast<float>(eye_rays),
                                                                *m.scratch);
                sum = glm::dvec3(s.radiance);
                count(s);
            } else {
                shadings.assign(points.size(), {});
                m.shader->shade(points, shadings, *m.scratch);
                for (std::size_t i = 0; i < points.size(); ++i) {
                    sum += glm::dvec3(points[i].weight) * glm::dvec3(shadings[i].radiance) / double(eye_rays);
                    count(shadings[i]);
                }
            }
            m.pixels.push_back(sum);
        }
    }

    static double middle(std::vector<double> values) {
        std::sort(values.begin(), values.end());
        return values[values.size() / 2];
    }

    static double error(const Method& m, const Method& reference) {
        double difference = 0, whole = 0;
        for (std::size_t i = 0; i < m.pixels.size(); ++i) {
            const glm::dvec3 d = m.pixels[i] - reference.pixels[i];
            difference += glm::dot(d, d);
            whole += glm::dot(reference.pixels[i], reference.pixels[i]);
        }
        return std::sqrt(difference / whole);
    }

    const Arguments& arguments_;
    render::Options options_;
    render::Scene scene_;
    render::RayScene rays_;
    render::EyePathTracer tracer_;
    render::PixelFilter filter_;
    render::MovingView view_;
    std::vector<render::SurfacePoint> points_;
    std::vector<std::size_t> first_;  ///< of each pixel in `points_`; one more at the end
    double eye_seconds_ = 0;
    double lobes_ = 0;
    Plots plots_;
};

void write(const Plots& plots, const std::filesystem::path& folder) {
    for (const auto& [plot, name] : {std::pair(&plots.milliseconds, "multidimensional-time.svg"),
                                     std::pair(&plots.clusters, "multidimensional-cut.svg")}) {
        render::OutputFile file(folder / name);
        std::ofstream stream(file.path(), std::ios::binary);
        stream << to_svg(*plot);
        stream.close();
        if (!stream) throw lightcuts::invalid_input((folder / name).string() + ": cannot be written");
        file.commit();
    }
}

}  // namespace

int main(int argc, char** argv) {
    Arguments arguments;
    CLI::App app{"Cost of pixels of many eye rays"};
    app.add_option("--scene", arguments.scenes,
                   "as of bench-error_vs_time, with its lens, fog and shutter; repeatable (builtin:hall)");
    app.add_option("--eye-rays", arguments.eye_rays, "a pixel (1 4 16 64 256)");
    app.add_option("--width", arguments.width, "of the picture, pixels (640)")->check(CLI::Range(1, 4096));
    app.add_option("--height", arguments.height, "of the picture, pixels (480)")->check(CLI::Range(1, 4096));
    app.add_option("--pixels", arguments.pixels, "of it that are shaded, about (192)")->check(CLI::Range(1, 1 << 20));
    app.add_option("--runs", arguments.runs, "medians are over this odd number (3)")->check(odd_number());
    app.add_flag("--alone", arguments.alone, "multidimensional lightcuts alone");
    app.add_option("--plots", arguments.plots, "folder for plots of the last scene");
    app.add_option("--errors-up-to", arguments.reference_rays,
                   "eye rays for which errors are told, which takes long (0)");
    CLI11_PARSE(app, argc, argv);
    try {
        if (!arguments.plots.empty()) render::require_writable(arguments.plots / "multidimensional-time.svg");
        for (const std::string& name : arguments.scenes) {
            Contest contest(name, arguments);
            std::printf("%s: %zu triangles, %zu lights\n", name.c_str(), contest.scene().triangles.size(),
                        contest.scene().light_count());
            for (const int eye_rays : arguments.eye_rays) contest.print(eye_rays);
            if (!arguments.plots.empty()) write(contest.plots(), arguments.plots);
        }
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "bench-multidimensional: %s\n", e.what());
        return 1;
    }
}
