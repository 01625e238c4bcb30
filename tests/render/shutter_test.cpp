#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <render/shutter.hpp>

namespace {

using render::Shutter;
using render::ShutterShape;

TEST(Shutter, GivesEachInstantTheSameLight) {
    const Shutter box{0.0, 1.0, 4, ShutterShape::box};
    EXPECT_EQ(render::times_of_instants(box), (std::vector<float>{0.125f, 0.375f, 0.625f, 0.875f}));

    const Shutter gaussian{0.0, 1.0, 64, ShutterShape::gaussian};
    const std::vector<float> times = render::times_of_instants(gaussian);
    ASSERT_EQ(times.size(), 64u);
    EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
    // Summed up numerically: the share of a Gaussian of two standard deviations to either side before each.
    const auto density = [](double t) { return std::exp(-0.5 * std::pow(4.0 * t - 2.0, 2.0)); };
    constexpr int steps = 200000;
    double all = 0.0;
    for (int i = 0; i < steps; ++i) all += density((i + 0.5) / steps);
    double before = 0.0;
    std::size_t next = 0;
    for (int i = 0; i < steps && next < times.size(); ++i) {
        before += density((i + 0.5) / steps) / all;
        if ((i + 1.0) / steps < static_cast<double>(times[next])) continue;
        EXPECT_NEAR(before, (static_cast<double>(next) + 0.5) / 64.0, 1e-4);
        ++next;
    }
    EXPECT_EQ(next, times.size());
}

TEST(Shutter, IsInItsMiddleAtASingleInstant) {
    for (const ShutterShape shape : {ShutterShape::box, ShutterShape::gaussian}) {
        EXPECT_NEAR(render::times_of_instants({0.0, 1.0, 1, shape}).at(0), 0.5f, 1e-6f);
    }
}

TEST(Shutter, SpreadsThePixelsRaysEvenlyOverTheInstants) {
    for (const std::uint32_t instants : {2u, 3u, 7u, 64u}) {
        for (const std::uint32_t rays_each : {1u, 2u, 5u}) {
            const std::uint32_t spp = instants * rays_each;
            for (std::uint32_t pixel = 0; pixel < 20; ++pixel) {
                std::vector<std::uint32_t> rays(instants);
                for (std::uint32_t sample = 0; sample < spp; ++sample) {
                    ++rays.at(render::instant_of_ray(1, pixel, sample, spp, instants));
                }
                EXPECT_EQ(rays, std::vector<std::uint32_t>(instants, rays_each)) << instants << ", pixel " << pixel;
            }
        }
    }
}

TEST(Shutter, TakesEveryInstantEquallyOftenWithFewerRays) {
    constexpr std::uint32_t instants = 10;
    constexpr std::uint32_t pixels = 20000;
    for (const std::uint32_t spp : {1u, 3u, 4u}) {
        std::vector<double> rays(instants);
        std::vector<double> of_first(instants);
        for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
            for (std::uint32_t sample = 0; sample < spp; ++sample) {
                const std::uint32_t t = render::instant_of_ray(7, pixel, sample, spp, instants);
                rays.at(t) += 1.0;
                if (sample == 0) of_first.at(t) += 1.0;
            }
        }
        // Six standard deviations of as many independent choices.
        for (const auto& [counts, all] : {std::pair{rays, 1.0 * spp * pixels}, {of_first, 1.0 * pixels}}) {
            for (const double count : counts) EXPECT_NEAR(count, all / instants, 6.0 * std::sqrt(all / instants));
        }
    }
}

TEST(Shutter, KeepsTheInstantInAName) {
    EXPECT_EQ(render::name_with_instant(0xdeadbeefu, 0, 0), 0xdeadbeefu) << "where nothing moves";
    EXPECT_EQ(render::name_with_instant(0xdeadbeefu, 0, 1), 0xdeadbeefu);
    for (const std::size_t instants : {2u, 3u, 100u, 256u, 65536u}) {
        for (std::uint32_t t = 0; t < instants; t += 1 + static_cast<std::uint32_t>(instants) / 50) {
            const std::uint32_t name = render::name_with_instant(0xdeadbeefu, t, instants);
            EXPECT_EQ(render::instant_in_name(name, instants), t);
            EXPECT_EQ(name >> 16, 0xdeadu);
        }
    }
}

}  // namespace
