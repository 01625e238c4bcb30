#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include <daylight/patch_light.hpp>
#include <daylight/reinhart_patches.hpp>
#include <glm/geometric.hpp>
#include <lightcuts/piecewise/even_directions.hpp>

namespace {

using namespace daylighting;

constexpr double pi = std::numbers::pi;

TEST(ReinhartPatches, are_as_many_as_Radiance_has) {
    EXPECT_EQ(ReinhartPatches(1).size(), 146u);
    EXPECT_EQ(ReinhartPatches(2).size(), 578u);
    EXPECT_EQ(ReinhartPatches(3).size(), 1298u);
    EXPECT_EQ(ReinhartPatches(4).size(), 2306u);
    for (int division = 1; division <= 16; ++division) {
        EXPECT_EQ(ReinhartPatches::division_of(ReinhartPatches(division).size()), division);
    }
    for (const std::size_t size : {0u, 1u, 2u, 145u, 147u, 577u, 2305u}) {
        EXPECT_FALSE(ReinhartPatches::division_of(size).has_value()) << size;
    }
}

TEST(ReinhartPatches, are_Tregenzas_where_they_are_not_divided) {
    const ReinhartPatches patches(1);
    // Rows of 12 degrees; the first patch of each is centered at north, the next ones go on to the east.
    EXPECT_NEAR(patches.center(1).y, std::cos(6.0 * pi / 180.0), 1e-12);
    EXPECT_NEAR(patches.center(1).x, 0.0, 1e-12);
    EXPECT_NEAR(std::atan2(patches.center(2).x, patches.center(2).y), 12.0 * pi / 180.0, 1e-12);
    EXPECT_NEAR(std::asin(patches.center(31).z), 18.0 * pi / 180.0, 1e-12);
    EXPECT_NEAR(std::asin(patches.center(144).z), 78.0 * pi / 180.0, 1e-12);
    EXPECT_EQ(patches.center(145).z, 1.0);
    // As tables of Tregenza's patches have them, in sr.
    EXPECT_NEAR(patches.solid_angle(1), 0.0435, 5e-5);
    EXPECT_NEAR(patches.solid_angle(61), 0.0474, 5e-5);
    EXPECT_NEAR(patches.solid_angle(145), 0.0344, 5e-5);
}

TEST(ReinhartPatches, divide_the_sphere) {
    const std::vector<glm::vec3> even = lightcuts::even_directions(20000);
    for (const int division : {1, 2, 4}) {
        const ReinhartPatches patches(division);
        double all = 0.0, projected = 0.0;
        for (std::size_t p = 0; p < patches.size(); ++p) {
            all += patches.solid_angle(p);
            projected += patches.projected(p);
            EXPECT_EQ(patches.of(patches.center(p)), p);
        }
        EXPECT_NEAR(all, 4.0 * pi, 1e-12);
        EXPECT_NEAR(projected, pi, 1e-12);
        if (division > 1) continue;
        // Solid angles and projected ones by counting directions.
        std::vector<double> counted(patches.size()), sines(patches.size());
        for (const glm::vec3& d : even) {
            counted[patches.of(d)] += 4.0 * pi / 20000.0;
            sines[patches.of(d)] += 4.0 * pi / 20000.0 * static_cast<double>(d.z);
        }
        for (std::size_t p = 0; p < patches.size(); ++p) {
            EXPECT_NEAR(counted[p], patches.solid_angle(p), p == 0 ? 0.05 : 0.006) << p;
            if (p > 0) { EXPECT_NEAR(sines[p], patches.projected(p), 0.006) << p; }
        }
    }
}

TEST(PatchLight, gives_of_each_patch_what_its_solid_angle_says) {
    // Few directions, so that most patches of the second have none of their own.
    std::vector<glm::dvec3> directions;
    for (const glm::vec3& d : lightcuts::even_directions(1000)) directions.emplace_back(d);
    for (const int division : {1, 4}) {
        const ReinhartPatches patches(division);
        const PatchLight light(patches, directions);
        std::vector<float> luminances(patches.size());
        std::vector<double> spread(directions.size(), 7.0);
        for (std::size_t p = 1; p < patches.size(); p += 7) {
            luminances[p] = 100.0f;
            light.spread(luminances, spread);
            luminances[p] = 0.0f;
            double sum = 0.0;
            for (std::size_t i = 0; i < directions.size(); ++i) {
                sum += spread[i];
                if (spread[i] > 0.0) {
                    EXPECT_GT(glm::dot(directions[i], patches.center(p)), std::cos(0.2));
                    EXPECT_GT(directions[i].z, 0.0);
                }
            }
            EXPECT_NEAR(sum, 100.0 * patches.solid_angle(p), 1e-9);
        }
        luminances[0] = 100.0f;
        light.spread(luminances, spread);
        for (const double l : spread) EXPECT_EQ(l, 0.0);
    }
}

}  // namespace
