// Shading against the clock: refines a cut round by round, and stops when the time is spent.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <lightcuts/lightcuts.hpp>

int main() {
    std::mt19937 random(1);
    const auto uniform = [&](float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(random); };
    std::vector<lightcuts::OmniLight<float>> lights(100'000);
    for (auto& light : lights) {
        light.position = {uniform(-30, 30), uniform(-30, 30), uniform(4, 8)};
        light.intensity = std::pow(uniform(1e-4f, 1.0f), -1.2f);  // a few are bright, most are dim
    }
    const lightcuts::LightTree tree(lights);

    const lightcuts::Receiver point(glm::vec3(0.0f), lightcuts::Lambert{glm::vec3(0.0f, 0.0f, 1.0f), 0.5f});
    const auto visible = [](const auto&, const auto& light) {  // through the slits between some beams
        return std::fmod(std::fabs(light.position.x / light.position.z), 0.5f) < 0.4f;
    };

    // The budget is the only thing that stops us: no error is small enough, no cut too large.
    lightcuts::LightcutOptions options;
    options.error_ratio = 0.0f;
    options.max_cut = 0;
    const std::chrono::microseconds budget(2000);

    std::printf("    us      rays   radiance   certainly within\n");
    const auto start = std::chrono::steady_clock::now();
    const auto spent = [&] { return std::chrono::steady_clock::now() - start; };
    lightcuts::Lightcut cut(tree, point, visible, options);
    unsigned reported = 0;
    while (spent() < budget && cut.step()) {  // a round splits up to a few hundred clusters here
        const auto now = cut.result();        // an estimate that can be used, whenever one stops
        if (now.queries < 2 * reported) continue;
        reported = now.queries;
        std::printf("%6.0f %9u %10.2f %12.2f %%\n", std::chrono::duration<double, std::micro>(spent()).count(),
                    now.queries, now.radiance, 100.0f * now.error_bound / now.radiance);
    }
    const auto shaded = cut.result();

    const auto exact = lightcuts::exhaustive(tree, point, visible);
    const float error = std::fabs(shaded.radiance - exact.radiance);
    std::printf("in fact within %.3f %% of the %.2f that all %u rays give\n", 100.0f * error / exact.radiance,
                exact.radiance, exact.queries);

    // The last word is `unfinished`: it was the caller who stopped.
    const bool stopped_early = shaded.stop == lightcuts::StopReason::unfinished;
    return error <= shaded.error_bound && stopped_early ? 0 : 1;
}
