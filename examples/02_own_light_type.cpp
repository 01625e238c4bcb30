// Lights of one's own: the library reads them through members of the right names, and copies nothing.
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <lightcuts/lightcuts.hpp>

// A light bulb as its seller describes it. `position` and `intensity`, as functions or as data, make it a light.
struct Bulb {
    glm::vec3 mounted_at;
    float lumens;
    float warmth;  // 0: cold white, 1: candle

    glm::vec3 position() const { return mounted_at; }
    glm::vec3 intensity() const {
        const glm::vec3 tint = glm::pow(glm::vec3(1.0f, 0.55f, 0.16f), glm::vec3(warmth));
        return lumens / (4.0f * 3.14159265f) * tint;
    }
};

// A bulb as game engines have them, gone at 10 m. `falloff` replaces 1/d^2; how large it gets beyond a distance says
// `falloff_bound`. It is static if all lights of the type agree; see example 04 for lights that differ.
struct FadingBulb : Bulb {
    float falloff(float distance) const { return falloff_bound(distance); }
    static float falloff_bound(float nearest) {  // falloff only ever falls
        const float faded = std::fmax(0.0f, 1.0f - std::pow(nearest / 10.0f, 4.0f));
        return faded * faded / (nearest * nearest + 1.0f);
    }
};

// `direction`, the way the light travels, instead of `position` makes a light at infinity.
struct Star {
    float elevation, azimuth;  // radians
    float lux;

    glm::vec3 direction() const {
        return -glm::vec3(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                          std::sin(elevation));
    }
    glm::vec3 intensity() const { return glm::vec3(lux); }
};

int main() {
    std::mt19937 random(1);
    const auto uniform = [&](float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(random); };
    const auto bulb = [&] {
        return Bulb{{uniform(-15, 15), uniform(-15, 15), uniform(2, 6)}, uniform(200, 800), uniform(0, 1)};
    };
    std::vector<Bulb> bulbs(20'000);
    for (Bulb& b : bulbs) b = bulb();
    std::vector<FadingBulb> fading(20'000);
    for (FadingBulb& b : fading) b = {bulb()};
    std::vector<Star> stars(20'000);
    for (Star& s : stars) s = {uniform(0.0f, 1.57f), uniform(0.0f, 6.28f), uniform(0.0f, 5.0f)};

    // One tree a kind, all refined as one cut.
    const lightcuts::LightTree bulb_tree(bulbs);
    const lightcuts::LightTree fading_tree(fading);
    const lightcuts::LightTree star_tree(stars);
    const lightcuts::LightForest lights(bulb_tree, fading_tree, star_tree);

    // An oracle sees the light itself: here a roof to the west shuts out the stars, but none of the bulbs.
    const auto visible = []<class L>(const auto&, const L& light) {
        if constexpr (lightcuts::DirectionalLight<L>) {
            return light.direction().x < 0.0f;
        } else {
            return true;
        }
    };

    const lightcuts::Receiver floor(glm::vec3(0.0f), lightcuts::Lambert{glm::vec3(0.0f, 0.0f, 1.0f), glm::vec3(0.5f)});
    const auto shaded = lightcuts::shade(lights, floor, visible);
    const auto exact = lightcuts::exhaustive(lights, floor, visible);

    bool good = shaded.queries < 1000;
    for (int c = 0; c < 3; ++c) {
        const float error = std::fabs(shaded.radiance[c] - exact.radiance[c]);
        std::printf("%c: lightcut %8.1f   exhaustive %8.1f   off by %.2f %%\n", "rgb"[c], shaded.radiance[c],
                    exact.radiance[c], 100.0f * error / exact.radiance[c]);
        good = good && error <= shaded.error_bound[c] && error < 0.1f * exact.radiance[c];
    }
    std::printf("%u shadow rays instead of %u\n", shaded.queries, exact.queries);
    return good ? 0 : 1;
}
