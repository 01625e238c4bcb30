#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <lightcuts/light/directional.hpp>
#include <lightcuts/light/omni.hpp>
#include <lightcuts/light/oriented.hpp>
#include <lightcuts/light/spot.hpp>
#include <lightcuts/material/ggx.hpp>
#include <lightcuts/material/lambert.hpp>
#include <lightcuts/material/sum.hpp>
#include <lightcuts/shading/receiver.hpp>
#include "support/occluders.hpp"
#include "support/random.hpp"

namespace lightcuts::test {

/// A room of 4 x 3 x 5, turned against the axes, in which every kind of light, receiver and occluder stands. Made of
/// `S` and of any seed.
template <Spectrum S>
class Room {
public:
    explicit Room(std::uint64_t seed) : random_(seed) {}

    std::vector<OmniLight<S>> omni(std::size_t n) {
        std::vector<OmniLight<S>> lights(n);
        for (auto& l : lights) l = {at(random_.in_box({-1.9, -1.4, -2.4}, {1.9, 1.4, 2.4})), some_intensity(), {}};
        return lights;
    }
    /// On the walls, facing inwards.
    std::vector<OrientedPointLight<S>> oriented(std::size_t n) {
        std::vector<OrientedPointLight<S>> lights(n);
        for (auto& l : lights) {
            const auto [p, axis] = on_wall();
            l = {at(p), direction(axis), some_intensity(), {}};
        }
        return lights;
    }
    std::vector<SpotLight<S>> spot(std::size_t n) {
        std::vector<SpotLight<S>> lights(n);
        for (auto& l : lights) {
            const auto [p, axis] = on_wall();
            l = {at(p), direction(random_.near(axis, 0.5)), some_intensity(), {0.9f, random_.real(0.2, 0.8)}};
        }
        return lights;
    }
    /// From above.
    std::vector<DistantLight<S>> distant(std::size_t n) {
        std::vector<DistantLight<S>> lights(n);
        for (auto& l : lights) l = {glm::vec3(random_.near({0.0, -1.0, 0.0}, 1.2)), some_intensity()};
        return lights;
    }

    std::vector<Receiver<Lambert<S>>> diffuse_receivers(std::size_t n) {
        std::vector<Receiver<Lambert<S>>> receivers;
        for (std::uint32_t i = 0; i < n; ++i) {
            const auto [p, normal] = inside();
            receivers.push_back({p, Lambert<S>{normal, albedo()}, p + 1e-4f * normal, i});
        }
        return receivers;
    }
    using Glossy = Sum<Lambert<S>, Ggx<S>>;
    std::vector<Receiver<Glossy>> glossy_receivers(std::size_t n) {
        std::vector<Receiver<Glossy>> receivers;
        for (std::uint32_t i = 0; i < n; ++i) {
            const auto [p, normal] = inside();
            const glm::vec3 view(random_.near(glm::normalize(glm::dvec3(normal)), 1.4));
            const Glossy material(Lambert<S>{normal, albedo()},
                                  Ggx<S>(normal, view, albedo(), random_.real(0.05, 0.6)));
            receivers.push_back({p, material, p + 1e-4f * normal, i});
        }
        return receivers;
    }

    Occluders occluders() {
        Occluders all;
        for (int i = 0; i < 6; ++i) all.add_sphere(glm::dvec3(inside().first), random_.between(0.1, 0.5));
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 p(inside().first);
            all.add_triangle(p, p + random_.on_sphere(), p + random_.on_sphere());
        }
        return all;
    }

private:
    static glm::dvec3 turned(const glm::dvec3& v) {
        constexpr double c = 0.8, s = 0.6;
        const glm::dvec3 about_y(c * v.x + s * v.z, v.y, c * v.z - s * v.x);
        return {c * about_y.x - s * about_y.y, s * about_y.x + c * about_y.y, about_y.z};
    }
    static glm::vec3 at(const glm::dvec3& p) { return glm::vec3(turned(p)); }
    static glm::vec3 direction(const glm::dvec3& v) { return glm::vec3(glm::normalize(turned(v))); }

    std::pair<glm::dvec3, glm::dvec3> on_wall() {
        const glm::dvec3 half(2.0, 1.5, 2.5);
        glm::dvec3 p = random_.in_box(-half, half);
        glm::dvec3 axis(0.0);
        const int a = static_cast<int>(random_.below(3));
        const double side = random_.chance(0.5) ? 1.0 : -1.0;
        p[a] = side * half[a];
        axis[a] = -side;
        return {p, axis};
    }
    std::pair<glm::vec3, glm::vec3> inside() {
        const glm::vec3 p = at(random_.in_box({-1.7, -1.2, -2.2}, {1.7, 1.2, 2.2}));
        return {p, glm::vec3(random_.on_sphere())};
    }
    /// A color times a power that varies a hundredfold.
    S some_intensity() {
        const double power = random_.decades(-2.0, 0.0);
        return make_spectrum<S>([&](int) { return power * random_.between(0.2, 1.0); });
    }
    S albedo() {
        return make_spectrum<S>([&](int) { return random_.between(0.1, 0.9); });
    }

    Random random_;
};

}  // namespace lightcuts::test
