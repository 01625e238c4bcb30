// Lamps with measured emission: tables such as IES and EULUMDAT files hold, another one for each lamp if need be.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <random>
#include <vector>

#include <lightcuts/lightcuts.hpp>

// Relative emission every 10 degrees off the axis, 0 to 180, linear in between. The peak is 1.
struct Photometry {
    std::array<float, 19> relative;

    static float steps_of(float cosine) { return std::acos(cosine) * (18.0f / 3.14159265f); }

    float operator()(float cosine) const {
        const float steps = std::min(steps_of(cosine), 17.999f);
        const auto i = static_cast<std::size_t>(steps);
        const float t = steps - static_cast<float>(i);
        return (1.0f - t) * relative[i] + t * relative[i + 1];
    }

    // The largest emission at cosines from `cos_min` to `cos_max`: no interpolated value exceeds the entries at its
    // sides. The library calls it with a cluster's `envelope`.
    float emission_bound(float cos_min, float cos_max) const {
        const float first = std::min(std::floor(steps_of(cos_max)), 18.0f);
        const float last = std::min(std::ceil(steps_of(cos_min)), 18.0f);
        return *std::max_element(&relative[static_cast<std::size_t>(first)],
                                 &relative[static_cast<std::size_t>(last)] + 1);
    }

    // The table that is nowhere below `a` or `b`: what a cluster remembers of lamps that differ.
    friend Photometry merge(const Photometry& a, const Photometry& b) {
        Photometry both;
        std::ranges::transform(a.relative, b.relative, both.relative.begin(), std::ranges::max);
        return both;
    }
};

// `emission` makes a light with an axis a profiled one; `envelope` is where its bound comes from. Lights that all have
// the same profile need no envelope: a static `emission_bound` will do, and takes no memory.
struct StreetLamp {
    glm::vec3 position;
    glm::vec3 axis;
    glm::vec3 intensity;  // W/sr in the direction of the peak
    const Photometry* photometry;

    float emission(float cosine) const { return (*photometry)(cosine); }
    Photometry envelope() const { return *photometry; }
};

int main() {
    // Street lamps throw light sideways, so that the road between two of them is not dark; spots are narrow.
    const Photometry batwing{{0.40f, 0.42f, 0.46f, 0.52f, 0.62f, 0.78f, 0.97f, 1.00f, 0.35f, 0.02f}};
    const Photometry spot{{1.00f, 0.90f, 0.45f, 0.12f, 0.03f, 0.01f}};

    // A town at night: streets of lamps looking down, and signs lit from below.
    std::mt19937 random(1);
    std::uniform_real_distribution<float> across(-200.0f, 200.0f), tilt(-0.2f, 0.2f);
    std::vector<StreetLamp> lamps(50'000);
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        const bool is_spot = i % 5 == 0;
        const glm::vec3 axis{tilt(random), tilt(random), is_spot ? 1.0f : -1.0f};
        lamps[i].position = {across(random), 20.0f * std::round(across(random) / 20.0f), is_spot ? 1.0f : 8.0f};
        lamps[i].axis = glm::normalize(axis);
        lamps[i].intensity = is_spot ? glm::vec3(40.0f, 50.0f, 80.0f) : glm::vec3(60.0f, 40.0f, 15.0f);
        lamps[i].photometry = is_spot ? &spot : &batwing;
    }
    const lightcuts::LightTree tree(lamps);

    bool good = true;
    std::printf("  y [m]   lightcut  exhaustive   off by    cut\n");
    for (int y = 0; y <= 20; y += 4) {  // across a street, to the next one
        const lightcuts::Receiver road(glm::vec3(0.0f, y, 0.0f),
                                       lightcuts::Lambert{glm::vec3(0.0f, 0.0f, 1.0f), glm::vec3(0.2f)});
        const auto shaded = lightcuts::shade(tree, road);  // nothing casts shadows, and no ray is asked for
        const auto exact = lightcuts::exhaustive(tree, road);
        const float error = std::abs(shaded.radiance.r - exact.radiance.r);
        std::printf("%7d %10.2f %11.2f %7.2f %% %6u\n", y, shaded.radiance.r, exact.radiance.r,
                    100.0f * error / exact.radiance.r, shaded.cut_size);
        good = good && error <= shaded.error_bound.r && error < 0.1f * exact.radiance.r && shaded.cut_size < 1000;
    }
    return good ? 0 : 1;
}
