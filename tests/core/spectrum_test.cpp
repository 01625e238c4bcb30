#include <lightcuts/core/spectrum.hpp>

#include <array>
#include <limits>

#include <gtest/gtest.h>

namespace foreign_spectra {

/// Four bands, told to the library by its own members.
struct Bands {
    static constexpr int channels = 4;
    std::array<float, 4> value{};

    float operator[](int i) const { return value[static_cast<std::size_t>(i)]; }
    float& operator[](int i) { return value[static_cast<std::size_t>(i)]; }
    friend Bands operator+(Bands a, const Bands& b) {
        for (int i = 0; i < 4; ++i) a[i] += b[i];
        return a;
    }
    friend Bands operator*(Bands a, const Bands& b) {
        for (int i = 0; i < 4; ++i) a[i] *= b[i];
        return a;
    }
    friend Bands operator*(Bands a, float k) {
        for (int i = 0; i < 4; ++i) a[i] *= k;
        return a;
    }
};

/// A foreign color without an index operator, told to the library from outside.
struct Color {
    float red = 0.0f, green = 0.0f;

    friend Color operator+(Color a, Color b) { return {a.red + b.red, a.green + b.green}; }
    friend Color operator*(Color a, Color b) { return {a.red * b.red, a.green * b.green}; }
    friend Color operator*(Color a, float k) { return {a.red * k, a.green * k}; }
};

/// Has no channels.
struct NoChannels {
    friend NoChannels operator+(NoChannels a, NoChannels) { return a; }
    friend NoChannels operator*(NoChannels a, NoChannels) { return a; }
    friend NoChannels operator*(NoChannels a, float) { return a; }
};

}  // namespace foreign_spectra

template <>
struct lightcuts::spectrum_traits<foreign_spectra::Color> {
    static constexpr int channels = 2;
    static float channel(const foreign_spectra::Color& c, int i) { return i == 0 ? c.red : c.green; }
    static void set(foreign_spectra::Color& c, int i, float value) { (i == 0 ? c.red : c.green) = value; }
};

namespace {

using namespace lightcuts;
using namespace foreign_spectra;

static_assert(Spectrum<float> && Spectrum<double> && Spectrum<glm::vec3> && Spectrum<Bands> && Spectrum<Color>);
static_assert(!Spectrum<NoChannels> && !Spectrum<int*>);
static_assert(channels_of<float> == 1 && channels_of<glm::vec3> == 3 && channels_of<Bands> == 4);
static_assert(black<float>() == 0.0f && is_black(black<glm::vec3>()));
static_assert(channel_sum(glm::vec3(1.0f, 2.0f, 4.0f)) == 7.0);

template <class S>
void check_channels() {
    const S s = make_spectrum<S>([](int i) { return 1.5f + static_cast<float>(i); });
    const int n = channels_of<S>;
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
        EXPECT_EQ(channel(s, i), 1.5f + static_cast<float>(i));
        sum += 1.5 + i;
    }
    EXPECT_EQ(channel_sum(s), sum);
    EXPECT_EQ(channel_max(s), 0.5f + static_cast<float>(n));
    EXPECT_TRUE(is_black(black<S>()));
    EXPECT_FALSE(is_black(s));
}

TEST(Spectrum, EveryModelReadsAndWritesItsChannels) {
    check_channels<float>();
    check_channels<double>();
    check_channels<glm::vec3>();
    check_channels<Bands>();
    check_channels<Color>();
}

TEST(Spectrum, OneBrightChannelIsNotBlack) {
    EXPECT_FALSE(is_black(glm::vec3(0.0f, 0.0f, std::numeric_limits<float>::denorm_min())));
    EXPECT_TRUE(is_black(glm::vec3(0.0f, -0.0f, 0.0f)));
    EXPECT_EQ(channel_max(glm::vec3(1.0f, 3.0f, 2.0f)), 3.0f);
}

TEST(Spectrum, SumsDoNotOverflow) {
    const float largest = std::numeric_limits<float>::max();
    EXPECT_EQ(channel_sum(glm::vec3(largest)), 3.0 * static_cast<double>(largest));
}

}  // namespace
