// A spectrum of one's own: eight bands of 50 nm instead of red, green and blue.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

#include <lightcuts/lightcuts.hpp>

// Say how many channels there are, let them be indexed, and add and multiply channel by channel. Zero is darkness.
struct Bands {
    static constexpr int channels = 8;
    std::array<float, channels> power{};

    float operator[](int i) const { return power[static_cast<std::size_t>(i)]; }
    float& operator[](int i) { return power[static_cast<std::size_t>(i)]; }

    friend Bands operator+(Bands a, const Bands& b) {
        for (int i = 0; i < channels; ++i) a[i] += b[i];
        return a;
    }
    friend Bands operator*(Bands a, const Bands& b) {
        for (int i = 0; i < channels; ++i) a[i] *= b[i];
        return a;
    }
    friend Bands operator*(Bands a, float scale) {
        for (int i = 0; i < channels; ++i) a[i] *= scale;
        return a;
    }
};
static_assert(lightcuts::Spectrum<Bands>);

int main() {
    //             nm: 375  425   475   525   575   625   675   725
    const Bands sodium{{0.0f, 0.0f, 0.01f, 0.03f, 1.0f, 0.2f, 0.02f, 0.01f}};
    const Bands white_led{{0.0f, 0.3f, 0.6f, 0.5f, 0.6f, 0.5f, 0.2f, 0.1f}};
    const Bands leaf{{0.03f, 0.04f, 0.05f, 0.13f, 0.10f, 0.06f, 0.05f, 0.45f}};  // reflectance

    // Sodium lamps on the one side of the river, LEDs on the other.
    std::mt19937 random(1);
    std::uniform_real_distribution<float> along(-40.0f, 40.0f), height(3.0f, 9.0f);
    std::vector<lightcuts::OmniLight<Bands>> lamps(50'000);
    for (auto& lamp : lamps) {
        const float x = along(random), y = along(random), z = height(random);
        lamp.position = {x, y, z};
        lamp.intensity = (x < 0.0f ? sodium : white_led) * 40.0f;  // W/sr
    }
    const lightcuts::LightTree tree(lamps);

    const lightcuts::Receiver point(glm::vec3(0.0f), lightcuts::Lambert{glm::vec3(0.0f, 0.0f, 1.0f), leaf});
    const auto shaded = lightcuts::shade(tree, point);  // no channel of any cluster is off by more than 2 %
    const auto exact = lightcuts::exhaustive(tree, point);

    bool good = shaded.cut_size < 1000;
    std::printf("  nm   lightcut  exhaustive\n");
    for (int i = 0; i < Bands::channels; ++i) {
        std::printf("%4d %10.2f %11.2f  ", 375 + 50 * i, shaded.radiance[i], exact.radiance[i]);
        std::puts(std::string(static_cast<std::size_t>(shaded.radiance[i] / 2.0f), '#').c_str());
        const float error = std::fabs(shaded.radiance[i] - exact.radiance[i]);
        good = good && error <= shaded.error_bound[i] && error <= 0.1f * exact.radiance[i];
    }
    std::printf("a cut of %u clusters for %zu lamps\n", shaded.cut_size, lamps.size());
    return good ? 0 : 1;
}
