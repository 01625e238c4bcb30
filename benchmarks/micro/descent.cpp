/// What a sample of the methods that draw lights from a tree costs outside rays: everything is visible. One thread.
/// Prints a table and writes descent.json.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include <lightcuts/estimate/adaptive_splitting.hpp>
#include <lightcuts/estimate/exhaustive.hpp>
#include <lightcuts/estimate/stochastic_lightcuts.hpp>
#include <lightcuts/estimate/tree_sampling.hpp>
#include <lightcuts/light/omni.hpp>
#include <lightcuts/light/oriented.hpp>
#include <lightcuts/material/ggx.hpp>
#include <lightcuts/material/lambert.hpp>
#include <lightcuts/material/sum.hpp>

#include "figures.hpp"
#include "timing.hpp"

namespace {

using namespace lightcuts;
using Glossy = Sum<Lambert<>, Ggx<>>;

float uniform(std::uint64_t a, std::uint64_t b) { return static_cast<float>(uniform01(hash_keys(a, b))); }

/// A place on the inside of a box of 20 x 6 x 12 and the direction into the box there.
struct Place {
    glm::vec3 position;
    glm::vec3 inwards;
};
Place on_a_wall(std::uint64_t seed, std::uint64_t i) {
    const glm::vec3 size(20.0f, 6.0f, 12.0f);
    glm::vec3 at(uniform(seed, 8 * i), uniform(seed, 8 * i + 1), uniform(seed, 8 * i + 2));
    glm::vec3 inwards(0.0f);
    const int side = static_cast<int>(6.0f * uniform(seed, 8 * i + 3));
    at[side / 2] = side % 2 == 0 ? 0.0f : 1.0f;
    inwards[side / 2] = side % 2 == 0 ? 1.0f : -1.0f;
    return {at * size, inwards};
}

std::vector<OrientedPointLight<>> oriented_lights(std::size_t count) {
    std::vector<OrientedPointLight<>> lights(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Place place = on_a_wall(1, i);
        lights[i] = {place.position, place.inwards, glm::vec3(0.1f + uniform(2, i)), {}};
    }
    return lights;
}

std::vector<OmniLight<>> omni_lights(std::size_t count) {
    std::vector<OmniLight<>> lights(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 at(uniform(3, 4 * i), uniform(3, 4 * i + 1), uniform(3, 4 * i + 2));
        lights[i] = {at * glm::vec3(20.0f, 6.0f, 12.0f), glm::vec3(0.1f + uniform(4, i)), {}};
    }
    return lights;
}

template <class M, class F>
std::vector<Receiver<M>> receivers(const F& material) {
    std::vector<Receiver<M>> all;
    for (std::uint32_t i = 0; i < 256; ++i) {
        const Place place = on_a_wall(5, i);
        const glm::vec3 off = place.position + 1e-4f * place.inwards;
        all.push_back({off, material(place), off, i});
    }
    return all;
}

/// Nanoseconds a sample of each method over all receivers, and the relative RMSE of what they find without shadows.
template <class Forest, class M>
void measure(const std::string& name, const Forest& forest, const std::vector<Receiver<M>>& all, int runs,
             nlohmann::json& rows) {
    EstimateScratch<glm::vec3> scratch;
    const AlwaysVisible open;
    std::vector<glm::vec3> exact;
    double square = 0.0;
    for (const auto& receiver : all) {
        exact.push_back(exhaustive(forest, receiver, open, scratch).radiance);
        square += static_cast<double>(glm::dot(exact.back(), exact.back()));
    }
    for (const std::uint32_t samples : {16u, 64u, 256u}) {
        const auto time = [&](const char* method, const auto& estimate) {
            double square_error = 0.0;
            const double ns = benchmark::nanoseconds(runs, static_cast<int>(all.size()), [&](int i) {
                const auto at = static_cast<std::size_t>(i);
                const glm::vec3 error = estimate(all[at]).radiance - exact[at];
                square_error += static_cast<double>(glm::dot(error, error));
                return samples;
            });
            const double rmse = std::sqrt(square_error / (runs * square));
            std::printf("%-28s %-20s %8u %12.1f %11.2f %%\n", name.c_str(), method, samples, ns, 100.0 * rmse);
            std::fflush(stdout);
            rows.push_back({{"scene", name},
                            {"method", method},
                            {"samples", samples},
                            {"ns_a_sample", ns},
                            {"relative_rmse", rmse}});
        };
        time("tree sampling", [&](const auto& r) { return tree_sampling(forest, r, open, samples, 1, scratch); });
        time("adaptive splitting",
             [&](const auto& r) { return adaptive_splitting(forest, r, open, 0.1f, samples, 1, scratch); });
        time("stochastic lightcuts",
             [&](const auto& r) { return stochastic_lightcuts(forest, r, open, samples, 1, scratch); });
    }
}

}  // namespace

int main(int argc, char** argv) {
    std::string only;
    int runs = 5;
    CLI::App app{"Time a sample of the methods that draw lights from a tree, outside rays"};
    app.add_option("--only", only, "measure only where lights and surfaces contain this");
    app.add_option("--runs", runs, "medians are over this odd number")->check(benchmark::odd_number());
    CLI11_PARSE(app, argc, argv);
    return benchmark::write_figures("bench-descent", "descent.json", [&] {
        nlohmann::json rows = nlohmann::json::array();
        std::printf("%-28s %-20s %8s %12s %13s\n", "lights, surfaces", "method", "samples", "ns a sample", "rel. RMSE");
        const auto diffuse = receivers<Lambert<>>([](const Place& p) { return Lambert<>{p.inwards, glm::vec3(0.5f)}; });
        const auto glossy = receivers<Glossy>([](const Place& p) {
            const glm::vec3 view = glm::normalize(glm::vec3(10.0f, 3.0f, 6.0f) - p.position);
            return Glossy(Lambert<>{p.inwards, glm::vec3(0.4f)}, Ggx<>(p.inwards, view, glm::vec3(0.2f), 0.3f));
        });
        for (const std::size_t count : {std::size_t{3000}, std::size_t{300000}}) {
            const std::string lights = std::to_string(count);
            const auto omni = omni_lights(count);
            const auto oriented = oriented_lights(count);
            const LightTree omni_tree(omni);
            const LightTree oriented_tree(oriented);
            const auto measure_if = [&](const std::string& name, const auto& tree, const auto& all) {
                if (name.find(only) != std::string::npos) measure(name, LightForest(tree), all, runs, rows);
            };
            measure_if("omni " + lights + ", diffuse", omni_tree, diffuse);
            measure_if("oriented " + lights + ", diffuse", oriented_tree, diffuse);
            measure_if("oriented " + lights + ", glossy", oriented_tree, glossy);
        }
        return rows;
    });
}
