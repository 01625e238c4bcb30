#include <lightcuts/cut/pilot_places.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>
#include <glm/vec3.hpp>

#include "support/random.hpp"

namespace lightcuts::test {
namespace {

using detail::PilotPlace;
using detail::PilotPlaces;
using Neighbor = PilotPlaces::Neighbor;

std::vector<PilotPlace> some_places(Random& random, std::size_t count) {
    std::vector<PilotPlace> places(count);
    for (std::size_t i = 0; i < count; ++i) {
        places[i] = {glm::vec3(random.in_box({-1, -2, 0}, {1, 2, 0.1})), glm::vec3(random.on_sphere())};
        if (i % 3 == 1) places[i] = places[i - 1];  // as near as another
        if (i % 5 == 0) places[i].normal = glm::vec3(0.0f);
    }
    return places;
}

/// All of them, the nearest first, by the definition.
std::vector<Neighbor> by_distance(const std::vector<PilotPlace>& places, const PilotPlace& at, double normal_length) {
    Box box;
    for (const PilotPlace& p : places) box = merge(box, box_of(p.position));
    const double extent2 = diagonal2(box) > 0.0 ? diagonal2(box) : 1.0;
    const auto length2 = [](const glm::dvec3& v) { return v.x * v.x + v.y * v.y + v.z * v.z; };
    std::vector<Neighbor> all;
    for (std::uint32_t i = 0; i < places.size(); ++i) {
        all.push_back({length2(glm::dvec3(places[i].position) - glm::dvec3(at.position)) +
                           normal_length * normal_length * extent2 *
                               length2(glm::dvec3(places[i].normal) - glm::dvec3(at.normal)),
                       i});
    }
    std::sort(all.begin(), all.end());
    return all;
}

TEST(PilotPlaces, FindTheNearestOfAll) {
    Random random(1);
    for (const std::size_t count : {1u, 2u, 7u, 500u}) {
        const auto places = some_places(random, count);
        const auto others = some_places(random, 50);
        for (const double normal_length : {0.0, 0.25, 10.0}) {
            const PilotPlaces found_in(places, normal_length);
            EXPECT_EQ(found_in.size(), count);
            for (const PilotPlace& at : others) {
                const auto expected = by_distance(places, at, normal_length);
                std::vector<Neighbor> found(9);
                ASSERT_EQ(found_in.nearest(at, found), std::min<std::size_t>(count, 9));
                for (std::size_t i = 0; i < std::min<std::size_t>(count, 9); ++i) {
                    EXPECT_NEAR(found[i].distance2, expected[i].distance2, 1e-12) << i;
                }
            }
        }
    }
}

TEST(PilotPlaces, FindTheFirstOfEqualOnes) {
    const PilotPlaces places(std::vector<PilotPlace>(20), 0.25);
    std::vector<Neighbor> found(3);
    EXPECT_EQ(places.nearest({}, found), 3u);
    for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(found[i].place, i);
}

TEST(PilotPlaces, OfNoneFindNone) {
    std::vector<Neighbor> found(3);
    EXPECT_EQ(PilotPlaces().nearest({}, found), 0u);
    EXPECT_EQ(PilotPlaces({}, 0.25).nearest({}, found), 0u);
    EXPECT_TRUE(PilotPlaces().empty());
}

}  // namespace
}  // namespace lightcuts::test
