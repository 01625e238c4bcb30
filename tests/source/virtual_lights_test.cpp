#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <lightcuts/light/directional.hpp>
#include <lightcuts/light/omni.hpp>
#include <lightcuts/light/spot.hpp>
#include <lightcuts/source/virtual_lights.hpp>
#include "support/random.hpp"
#include "support/statistics.hpp"
#include "support/threads.hpp"

namespace lightcuts::test {
namespace {

using V = glm::vec3;
constexpr double pi = std::numbers::pi;

struct Hit {
    V position, normal;
};

/// A diffuse direction; its weight is the albedo.
ScatteredParticle<V> diffuse(const Hit& hit, const V& albedo, const V& u) {
    const glm::dvec3 up(hit.normal);
    const glm::dvec3 way = Basis(up).out(around_z(std::sqrt(1.0 - double(u.x)), double(u.y)));
    return {hit.position + 1e-4f * hit.normal, V(way), albedo};
}

/// The inside of a sphere around the origin.
struct Ball {
    double radius;
    V albedo;

    std::optional<Hit> intersect(const V& origin, const V& direction) const {
        const glm::dvec3 o(origin), d(direction);
        const double b = glm::dot(o, d), a = glm::dot(d, d), c = glm::dot(o, o) - radius * radius;
        const glm::dvec3 at = glm::normalize(o + d * ((-b + std::sqrt(b * b - a * c)) / a));
        return Hit{V(radius * at), V(-at)};
    }
    V diffuse_albedo(const Hit&) const { return albedo; }
    ScatteredParticle<V> scatter(const Hit& hit, const V&, const V& u) const { return diffuse(hit, albedo, u); }
};

/// The inside of the box [0, 2] x [0, 1] x [0, 3]; its floor may be a mirror.
struct Chamber {
    V albedo;
    bool mirror_floor = false;

    std::optional<Hit> intersect(const V& origin, const V& direction) const {
        const V hi(2.0f, 1.0f, 3.0f);
        float nearest = 1e30f;
        Hit hit{};
        for (int k = 0; k < 3; ++k) {
            if (direction[k] == 0.0f) continue;
            const float t = ((direction[k] > 0.0f ? hi[k] : 0.0f) - origin[k]) / direction[k];
            if (t >= nearest) continue;
            nearest = t;
            hit = {origin + t * direction, V(0.0f)};
            hit.normal[k] = direction[k] > 0.0f ? -1.0f : 1.0f;
        }
        return hit;
    }
    V diffuse_albedo(const Hit& hit) const { return is_mirror(hit) ? V(0.0f) : albedo; }
    ScatteredParticle<V> scatter(const Hit& hit, const V& direction, const V& u) const {
        if (!is_mirror(hit)) return diffuse(hit, albedo, u);
        return {hit.position + 1e-4f * hit.normal, glm::reflect(direction, hit.normal), V(1.0f)};
    }

private:
    bool is_mirror(const Hit& hit) const { return mirror_floor && hit.normal.y > 0.5f; }
};

/// The square [0, 1] x [0, 1] at y = 0, white, under an empty sky. Seen from above only.
struct Floor {
    V albedo{1.0f};

    std::optional<Hit> intersect(const V& origin, const V& direction) const {
        if (!(direction.y < 0.0f && origin.y > 0.0f)) return std::nullopt;
        const V at = origin - direction * (origin.y / direction.y);
        if (at.x < 0.0f || at.x > 1.0f || at.z < 0.0f || at.z > 1.0f) return std::nullopt;
        return Hit{V(at.x, 0.0f, at.z), V(0.0f, 1.0f, 0.0f)};
    }
    V diffuse_albedo(const Hit&) const { return albedo; }
    ScatteredParticle<V> scatter(const Hit& hit, const V&, const V& u) const { return diffuse(hit, albedo, u); }
    Box bounds() const { return {V(0.0f), V(1.0f, 0.0f, 1.0f)}; }
};

/// The floor as a sheet that passes light on.
struct Sheet : Floor {
    struct SheetHit : Hit {
        V position_behind;
    };
    V transmittance{0.0f};

    std::optional<SheetHit> intersect(const V& origin, const V& direction) const {
        const auto hit = Floor::intersect(origin, direction);
        if (!hit) return std::nullopt;
        return SheetHit{*hit, hit->position - V(0.0f, 1e-4f, 0.0f)};
    }
    V diffuse_transmittance(const Hit&) const { return transmittance; }
};
static_assert(TransmissiveParticleScene<Sheet, V> && !TransmissiveParticleScene<Floor, V>);

static_assert(ParticleScene<Ball, V> && ParticleScene<Floor, V> && !ParticleScene<V, V>);

/// A medium without end, and nothing else.
struct Fog {
    double extinction = 2.0;
    MediumScattering<V> scattering{V(0.8f, 0.5f, 0.2f), 0.0f};

    std::optional<Hit> intersect(const V&, const V&) const { return std::nullopt; }
    V diffuse_albedo(const Hit&) const { return V(0.0f); }
    ScatteredParticle<V> scatter(const Hit&, const V&, const V&) const { return {}; }
    double free_flight(const V&, const V&, double u) const { return -std::log1p(-u) / extinction; }
    MediumScattering<V> scattering_at(const V&) const { return scattering; }
};
static_assert(ScatteringParticleScene<Fog, V> && !ScatteringParticleScene<Ball, V>);

/// A ball filled with fog.
struct FoggyBall : Ball {
    Fog fog;

    double free_flight(const V& origin, const V& direction, double u) const {
        return fog.free_flight(origin, direction, u);
    }
    MediumScattering<V> scattering_at(const V& p) const { return fog.scattering_at(p); }
};

double full_power(const ScatteringPointLight<V>& l) {
    const double narrow = 1.0 - double(l.profile.asymmetry);
    return 4.0 * pi * narrow * narrow / (1.0 + double(l.profile.asymmetry));
}

glm::dvec3 flux_of(const std::vector<ScatteringPointLight<V>>& lights) {
    glm::dvec3 sum(0.0);
    for (const auto& l : lights) sum += full_power(l) * glm::dvec3(l.intensity);
    return sum;
}

glm::dvec3 flux_of(const std::vector<OrientedPointLight<V>>& lights) {
    glm::dvec3 sum(0.0);
    for (const auto& l : lights) sum += pi * glm::dvec3(l.intensity);
    return sum;
}

/// In a closed room of one albedo a the light reflected is flux x (a + a^2 + ...) = flux x a / (1 - a).
template <class Room, class L>
void expect_geometric_series(const Room& room, const std::vector<L>& lights, const glm::dvec3& flux) {
    std::vector<Mean> means(3);
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const auto made = virtual_lights(room, ParticleSources(lights), {.lights = 500}, ScrambledSobol{seed});
        for (std::size_t c = 0; c < 3; ++c) means[c].add(flux_of(made.lights)[int(c)]);
    }
    for (std::size_t c = 0; c < 3; ++c) {
        const double a = double(room.albedo[int(c)]);
        const double truth = flux[int(c)] * a / (1.0 - a);
        EXPECT_LT(means[c].standard_errors_from(truth), 5.5) << means[c].value() << " against " << truth;
        EXPECT_NEAR(means[c].value() / truth, 1.0, 0.05);
    }
}

TEST(VirtualLights, CarryTheGeometricSeriesOfAFurnace) {
    const std::vector<OmniLight<>> omni{{V(0.3f, 0.4f, 0.2f), V(1.0f, 2.0f, 3.0f), {}},
                                        {V(0.7f, 0.2f, 0.1f), V(0.5f, 0.0f, 0.0f), {}}};
    const glm::dvec3 flux = 4.0 * pi * glm::dvec3(1.5, 2.0, 3.0);
    expect_geometric_series(Ball{2.0, V(0.8f, 0.5f, 0.2f)}, omni, flux);
    expect_geometric_series(Chamber{V(0.6f, 0.3f, 0.9f)}, omni, flux);
}

TEST(VirtualLights, LightASphereEvenlyByAClosedForm) {
    const Ball ball{2.0, V(0.5f)};
    const std::vector<OmniLight<>> omni{{V(0.5f, 0.0f, 0.0f), V(1.0f), {}}};
    const auto made = virtual_lights(ball, ParticleSources(omni), {.lights = 20000});
    // Between two points of a sphere cos cos' / d^2 is 1 / (4 R^2): the irradiance is the same everywhere.
    const double expected = 4.0 * pi * 0.5 / 0.5 / (4.0 * pi * 4.0);
    for (const glm::dvec3& at : {glm::dvec3(0, 0, 2), glm::dvec3(1.2, 1.6, 0), glm::dvec3(-2, 0, 0)}) {
        double sum = 0.0;
        for (const auto& l : made.lights) {
            const Incidence arriving = incidence(l, V(at));
            sum += arriving.geometric * std::max(0.0, glm::dot(glm::dvec3(arriving.to_light), -at / 2.0)) *
                   double(l.intensity.x);
        }
        EXPECT_NEAR(sum / expected, 1.0, 0.02);
    }
}

TEST(VirtualLights, AreOfEqualPowerAndAboutAsManyAsWanted) {
    const std::vector<OmniLight<>> omni{{V(0.3f, 0.4f, 0.2f), V(1.0f, 2.0f, 3.0f), {}}};
    const std::vector<OrientedPointLight<>> area{{V(1.0f, 0.9f, 1.0f), V(0.0f, -1.0f, 0.0f), V(20.0f, 1.0f, 0.0f), {}}};
    for (const std::size_t wanted : {1000u, 30000u}) {
        const auto made = virtual_lights(Chamber{V(0.7f, 0.5f, 0.3f)}, ParticleSources(omni, area), {.lights = wanted});
        EXPECT_NEAR(double(made.lights.size()) / double(wanted), 1.0, 0.1);
        EXPECT_EQ(made.landed, made.particles) << "nothing escapes a closed room";
        const double flux = 4.0 * pi * 6.0 + pi * 21.0;
        for (const auto& l : made.lights) {
            EXPECT_NEAR(pi * channel_sum(l.intensity) * double(made.particles) / flux, 1.0, 1e-5);
            EXPECT_NEAR(glm::length(l.axis), 1.0f, 1e-6f);
        }
    }
}

/// First bounces on the floor, against the irradiance that the light model itself states.
template <class L>
void expect_first_bounces_where_light_falls(const std::vector<L>& lights) {
    const Floor floor;
    const auto made = virtual_lights(floor, ParticleSources(lights), {.lights = 60000, .longest_path = 1});
    constexpr int cells = 4, fine = 40;
    std::vector<double> truth(cells * cells, 0.0), found(cells * cells, 0.0);
    for (int y = 0; y < cells * fine; ++y) {
        for (int x = 0; x < cells * fine; ++x) {
            const V at((float(x) + 0.5f) / (cells * fine), 0.0f, (float(y) + 0.5f) / (cells * fine));
            for (const L& l : lights) {
                const Incidence arriving = incidence(l, at);
                truth[std::size_t(y / fine * cells + x / fine)] += arriving.geometric *
                                                                   std::max(0.0f, arriving.to_light.y) *
                                                                   channel_sum(l.intensity) /
                                                                   (cells * fine * cells * fine);
            }
        }
    }
    double total = 0.0;
    for (const double t : truth) total += t;
    for (const auto& l : made.lights) {
        const auto cell = [](float c) { return std::min(cells - 1, int(c * cells)); };
        found[std::size_t(cell(l.position.z) * cells + cell(l.position.x))] += pi * channel_sum(l.intensity);
    }
    for (std::size_t i = 0; i < truth.size(); ++i) {
        EXPECT_NEAR(found[i] / total, truth[i] / total, 0.004 + 0.02 * truth[i] / total) << "cell " << i;
    }
}

TEST(VirtualLights, StartAsEveryKindOfLightEmits) {
    const V down = glm::normalize(V(0.3f, -1.0f, 0.2f));
    expect_first_bounces_where_light_falls<OmniLight<>>({{V(0.2f, 0.5f, 0.6f), V(1.0f), {}}});
    expect_first_bounces_where_light_falls<OrientedPointLight<>>(
        {{V(0.2f, 0.7f, 0.6f), down, V(1.0f), {}}, {V(0.9f, 0.3f, 0.1f), V(0.0f, -1.0f, 0.0f), V(0.1f), {}}});
    expect_first_bounces_where_light_falls<SpotLight<>>({{V(0.2f, 1.0f, 0.3f), down, V(1.0f), {0.98f, 0.9f}}});
    // Profiles that differ, and one that two lights share.
    const V straight(0.0f, -1.0f, 0.0f);
    expect_first_bounces_where_light_falls<SpotLight<>>({{V(0.2f, 1.0f, 0.3f), down, V(1.0f), {0.98f, 0.9f}},
                                                         {V(0.8f, 0.6f, 0.7f), straight, V(0.6f), {0.9f, 0.5f}},
                                                         {V(0.7f, 1.0f, 0.2f), straight, V(0.4f), {0.98f, 0.9f}}});
    expect_first_bounces_where_light_falls<DistantLight<>>({{down, V(1.0f)}, {V(0.0f, -1.0f, 0.0f), V(2.0f)}});
    using Soft = OmniLight<V, PolynomialFalloff>;
    expect_first_bounces_where_light_falls<Soft>({{V(0.5f, 0.5f, 0.5f), V(1.0f), {1.0f, 0.5f, 1.0f}}});
}

TEST(VirtualLights, TravelOverMirrorsWithoutStayingThere) {
    const Chamber room{V(0.4f, 0.4f, 0.4f), true};
    const std::vector<OmniLight<>> omni{{V(1.0f, 0.5f, 1.0f), V(1.0f), {}}};
    Mean mean;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const auto made = virtual_lights(room, ParticleSources(omni), {.lights = 500}, ScrambledSobol{seed});
        for (const auto& l : made.lights) EXPECT_LT(l.axis.y, 0.5f);
        mean.add(flux_of(made.lights).x);
    }
    // The mirror keeps all: each diffuse reflection follows the last one.
    EXPECT_LT(mean.standard_errors_from(4.0 * pi * 0.4 / 0.6), 6.0) << mean.value();
}

TEST(VirtualLights, LieOnBothSidesOfALeafByWhatLeavesThere) {
    Sheet leaf;
    leaf.albedo = V(0.1f, 0.5f, 0.0f);
    leaf.transmittance = V(0.3f, 0.2f, 0.6f);
    const std::vector<OrientedPointLight<V>> lamp{
        {V(0.5f, 0.01f, 0.5f), V(0.0f, -1.0f, 0.0f), V(1.0f, 2.0f, 3.0f), {}}};
    std::vector<Mean> above(3), behind(3);
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const auto made = virtual_lights(leaf, ParticleSources(lamp), {.lights = 500}, ScrambledSobol{seed});
        std::vector<OrientedPointLight<V>> up, down;
        for (const auto& l : made.lights) (l.axis.y > 0.0f ? up : down).push_back(l);
        for (const auto& l : up) EXPECT_EQ(l.position.y, 0.0f);
        for (const auto& l : down) EXPECT_EQ(l.position.y, -1e-4f);
        const double power = channel_sum(made.lights.front().intensity);
        for (const auto& l : made.lights) EXPECT_NEAR(channel_sum(l.intensity), power, 1e-5 * power);
        for (std::size_t c = 0; c < 3; ++c) {
            above[c].add(flux_of(up)[int(c)]);
            behind[c].add(flux_of(down)[int(c)]);
        }
    }
    for (std::size_t c = 0; c < 3; ++c) {
        // All but 0.1 % of the lamp's light lands.
        const double flux = pi * double(lamp[0].intensity[int(c)]);
        EXPECT_NEAR(above[c].value(), flux * double(leaf.albedo[int(c)]), 0.01 * flux);
        EXPECT_NEAR(behind[c].value(), flux * double(leaf.transmittance[int(c)]), 0.01 * flux);
    }
}

TEST(VirtualLights, AreOneWhereAParticleIsBrighterThanItsLights) {
    const Sheet leaf{{V(0.4f)}, V(0.2f)};
    const Sheet::SheetHit hit{{V(0.0f), V(0.0f, 1.0f, 0.0f)}, V(0.0f, -1e-4f, 0.0f)};
    const V power(1.0f, 2.0f, 3.0f);  // 2.4 of 6 go up and 1.2 down
    std::vector<OrientedPointLight<V>> lights;
    const int count = 3000;
    for (int i = 0; i < count; ++i) detail::leave_light(leaf, hit, power, (i + 0.5) / count, lights);
    ASSERT_EQ(lights.size(), std::size_t(count));
    glm::dvec3 up(0.0), down(0.0);
    for (const auto& l : lights) {
        EXPECT_NEAR(pi * channel_sum(l.intensity), 3.6, 1e-5);
        (l.axis.y > 0.0f ? up : down) += pi / count * glm::dvec3(l.intensity);
    }
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(up[c], 0.4 * double(power[c]), 1e-5);
        EXPECT_NEAR(down[c], 0.2 * double(power[c]), 1e-5);
    }
}

/// Of a medium of albedo a without end the light scattered is flux x (a + a^2 + ...), whatever its phase function.
TEST(VirtualLights, CarryTheGeometricSeriesOfAMedium) {
    const std::vector<OmniLight<>> omni{{V(0.3f, 0.4f, 0.2f), V(1.0f, 2.0f, 3.0f), {}}};
    for (const float g : {0.0f, 0.7f, -0.4f}) {
        std::vector<Mean> means(3);
        Fog fog;
        fog.scattering.asymmetry = g;
        for (std::uint64_t seed = 0; seed < 200; ++seed) {
            const auto made = virtual_lights(fog, ParticleSources(omni), {.lights = 500}, ScrambledSobol{seed});
            EXPECT_TRUE(made.lights.empty());
            EXPECT_NEAR(double(made.scattered.size()), 500.0, 200.0);
            EXPECT_EQ(made.landed, made.particles);
            const double power = full_power(made.scattered.front()) * channel_sum(made.scattered.front().intensity);
            for (const auto& l : made.scattered) {
                EXPECT_NEAR(full_power(l) * channel_sum(l.intensity), power, 1e-4 * power);
            }
            for (std::size_t c = 0; c < 3; ++c) means[c].add(flux_of(made.scattered)[int(c)]);
        }
        for (std::size_t c = 0; c < 3; ++c) {
            const double a = double(fog.scattering.albedo[int(c)]);
            const double truth = 4.0 * pi * double(omni[0].intensity[int(c)]) * a / (1.0 - a);
            EXPECT_LT(means[c].standard_errors_from(truth), 5.5) << means[c].value() << " against " << truth;
            EXPECT_NEAR(means[c].value() / truth, 1.0, 0.05);
        }
    }
}

/// A lamp in the middle of a ball: what is not stopped on the way lands.
TEST(VirtualLights, AreSharedBetweenMediumAndSurfaceByTheTransmittance) {
    FoggyBall room{{1.5, V(0.5f)}, {}};
    room.fog.scattering = {V(0.9f), 0.3f};
    const std::vector<OmniLight<>> omni{{V(0.0f), V(1.0f), {}}};
    // One flight each; the roulette leaves what is reflected or scattered.
    const auto made = virtual_lights(room, ParticleSources(omni), {.lights = 40000, .longest_path = 1});
    const double lands = std::exp(-room.fog.extinction * room.radius);
    EXPECT_NEAR(flux_of(made.lights).x / (4.0 * pi), 0.5 * lands, 0.002);
    EXPECT_NEAR(flux_of(made.scattered).x / (4.0 * pi), 0.9 * (1.0 - lands), 0.002);
    // Their mean distance is that of an exponential law cut off at the radius, and they go straight on.
    double distance = 0.0;
    for (const auto& l : made.scattered) {
        distance += double(glm::length(l.position));
        EXPECT_NEAR(glm::dot(l.axis, glm::normalize(l.position)), 1.0f, 1e-5f);
    }
    const double truth = (1.0 / room.fog.extinction) - room.radius * lands / (1.0 - lands);
    EXPECT_NEAR(distance / double(made.scattered.size()), truth, 0.002);
}

/// Once it is scattered twice, the mean cosine between two ways is the medium's.
TEST(VirtualLights, TurnByTheMeanCosineOfAMedium) {
    const std::vector<OrientedPointLight<V>> lamp{{V(0.0f), V(0.0f, 0.0f, 1.0f), V(1.0f), {}}};
    for (const float g : {0.6f, -0.6f}) {
        const MediumScattering<V> medium{V(1.0f), g};
        Mean turn;
        std::vector<ScatteringPointLight<V>> lights;
        Random random(7);
        for (int i = 0; i < 100000; ++i) {
            const V along(random.on_sphere());
            const auto next = detail::scatter_in_medium<V>(medium, V(1.0f), along, V(0.3f),
                                                           {random.unit(), random.unit()}, random.unit(), lights);
            EXPECT_EQ(next.weight, V(1.0f));
            turn.add(double(glm::dot(next.direction, along)));
        }
        EXPECT_LT(turn.standard_errors_from(double(g)), 4.5) << turn.value();
        EXPECT_NEAR(double(lights.size()), 90000.0, 1500.0);
    }
}

/// A room with a medium that stops nothing is the room: same lights, though drawn by other numbers.
TEST(VirtualLights, OfAMediumThatStopsNothingLieOnSurfaces) {
    FoggyBall room{{2.0, V(0.5f)}, {}};
    room.fog.extinction = 0.0;
    const std::vector<OmniLight<>> omni{{V(0.5f, 0.0f, 0.0f), V(1.0f), {}}};
    const auto made = virtual_lights(room, ParticleSources(omni), {.lights = 20000});
    EXPECT_TRUE(made.scattered.empty());
    EXPECT_NEAR(flux_of(made.lights).x / (4.0 * pi), 1.0, 0.02);
}

TEST(VirtualLights, DependOnTheSeedButNotOnThreads) {
    const Chamber room{V(0.7f)};
    const std::vector<OmniLight<>> omni{{V(1.0f, 0.5f, 1.0f), V(1.0f), {}}};
    const ParticleSources sources(omni);
    const auto a = virtual_lights(room, sources, {.lights = 30000});
    const auto b = virtual_lights(room, sources, {.lights = 30000}, ScrambledSobol{}, FourThreads{});
    const auto c = virtual_lights(room, sources, {.lights = 30000}, ScrambledSobol{1});
    ASSERT_EQ(a.lights.size(), b.lights.size());
    EXPECT_EQ(a.particles, b.particles);
    for (std::size_t i = 0; i < a.lights.size(); ++i) {
        ASSERT_EQ(a.lights[i].position, b.lights[i].position);
        ASSERT_EQ(a.lights[i].intensity, b.lights[i].intensity);
    }
    EXPECT_NE(a.lights.front().position, c.lights.front().position);
}

template <class Scene, class L>
std::string refusal(const Scene& scene, const std::vector<L>& lights) {
    try {
        virtual_lights(scene, ParticleSources(lights), {.lights = 100});
    } catch (const invalid_input& e) { return e.what(); }
    return "";
}

struct Nowhere : Floor {
    Box bounds() const { return {}; }
};

TEST(VirtualLights, RefuseWhatLightsNothing) {
    using testing::HasSubstr;
    using Omni = std::vector<OmniLight<>>;
    const auto at = [](float y, const V& intensity) { return Omni{{V(0.5f, y, 0.5f), intensity, {}}}; };
    EXPECT_THAT(refusal(Floor{}, Omni{}), HasSubstr("no light emits"));
    EXPECT_THAT(refusal(Floor{}, at(1.0f, V(0.0f))), HasSubstr("no light emits"));
    EXPECT_THAT(refusal(Floor{}, at(-1.0f, V(1.0f))), HasSubstr("particles from the lights met a surface or a medium"));
    EXPECT_THAT(refusal(Floor{V(0.0f)}, at(1.0f, V(1.0f))), HasSubstr("none was reflected or let through"));
    EXPECT_THAT(refusal(Sheet{{V(0.0f)}}, at(1.0f, V(1.0f))), HasSubstr("none was reflected or let through"));
    EXPECT_EQ(refusal(Sheet{{V(0.0f)}, V(0.5f)}, at(1.0f, V(1.0f))), "");
    EXPECT_THAT(refusal(Floor{}, at(1.0f, V(1.0f, -1.0f, 1.0f))), HasSubstr("light 0 of kind 0"));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(refusal(Floor{}, at(1.0f, V(nan))), HasSubstr("light 0 of kind 0"));
    EXPECT_THAT(refusal(Nowhere{}, std::vector<DistantLight<>>{{V(0.0f, -1.0f, 0.0f), V(1.0f)}}),
                HasSubstr("bounds are empty"));
    EXPECT_EQ(refusal(Floor{}, at(1.0f, V(1.0f))), "");
}

}  // namespace
}  // namespace lightcuts::test
