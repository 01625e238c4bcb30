#pragma once

#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>

#include <lightcuts/core/box.hpp>
#include <lightcuts/core/random.hpp>

/// Random and adversarial boxes of lights seen from a receiver, for the tests of bounds.
namespace configurations {

/// A seeded sequence of numbers.
class Draw {
public:
    explicit Draw(std::uint64_t seed) : seed_(seed) {}

    double unit() { return lightcuts::uniform01(bits()); }
    double uniform(double a, double b) { return a + (b - a) * unit(); }
    int below(int n) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n)); }
    bool chance(double p) { return unit() < p; }

    glm::dvec3 in_cube(double half) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }

    /// Uniform on the sphere.
    glm::dvec3 direction() {
        const double z = uniform(-1.0, 1.0);
        const double phi = uniform(0.0, 6.283185307179586);
        const double r = std::sqrt((1.0 - z) * (1.0 + z));
        return {r * std::cos(phi), r * std::sin(phi), z};
    }

private:
    std::uint64_t bits() { return lightcuts::hash_keys(seed_, count_++); }

    std::uint64_t seed_;
    std::uint64_t count_ = 0;
};

enum class Shape { ordinary, flat, needle, point, touching, containing, tiny, huge, far_off };
inline constexpr int shape_count = 9;

struct Configuration {
    Shape shape;
    lightcuts::Box lights;
    glm::vec3 receiver;

    lightcuts::OffsetBox box() const { return lightcuts::offsets(lights, receiver); }
};

/// `ordinary` boxes have a distance of `nearest` to 20 half-diagonals.
inline Configuration make(Shape shape, Draw& draw, double nearest = 0.6) {
    glm::dvec3 half(draw.unit(), draw.unit(), draw.unit());
    double scale = 1.0;
    glm::dvec3 receiver = draw.in_cube(1.0);
    switch (shape) {
        case Shape::flat: half[draw.below(3)] = 0.0; break;
        case Shape::needle: {
            const int axis = draw.below(3);
            for (int i = 0; i < 3; ++i) half[i] *= i == axis ? 1.0 : draw.chance(0.5) ? 1e-6 : 0.0;
            break;
        }
        case Shape::point: half = glm::dvec3(0.0); break;
        case Shape::tiny: scale = 1e-12; break;
        case Shape::huge: scale = 1e12; break;
        case Shape::far_off:
            receiver = draw.in_cube(1e6);
            half *= 1e-3;
            break;
        default: break;
    }
    const double radius = shape == Shape::point ? 1.0 : glm::length(half);
    glm::dvec3 offset = draw.direction() * radius * std::exp(draw.uniform(std::log(nearest), std::log(20.0)));
    if (draw.chance(0.1)) offset[draw.below(3)] = 0.0;
    if (shape == Shape::far_off) offset *= std::exp(draw.uniform(0.0, 7.0));
    if (shape == Shape::containing) offset = half * draw.in_cube(1.0);
    if (shape == Shape::touching) {
        for (int i = 0; i < 3; ++i) {
            const int side = draw.below(3);
            offset[i] = side == 0 ? half[i] : side == 1 ? -half[i] : half[i] * draw.uniform(-1.0, 1.0);
        }
        receiver = glm::dvec3(0.0);  // so that the sides touch after rounding, too
    }
    const glm::vec3 x(receiver * scale);
    const glm::vec3 a(receiver * scale + (offset - half) * scale);
    const glm::vec3 b(receiver * scale + (offset + half) * scale);
    return {shape, lightcuts::merge(lightcuts::box_of(a), lightcuts::box_of(b)), x};
}

inline Configuration make(Draw& draw, double nearest = 0.6) {
    return make(static_cast<Shape>(draw.below(shape_count)), draw, nearest);
}

/// A unit vector that is hard for `box` in one draw of two: along an axis, through a corner, perpendicular to a
/// corner's or the center's offset.
inline glm::dvec3 hard_direction(const lightcuts::OffsetBox& box, Draw& draw) {
    glm::dvec3 corner;
    for (int i = 0; i < 3; ++i) corner[i] = draw.chance(0.5) ? box.lo[i] : box.hi[i];
    const glm::dvec3 middle = center(box);
    const auto unit = [&](const glm::dvec3& v) {
        const double length = glm::length(v);
        return length > 0.0 ? v / length : draw.direction();
    };
    switch (draw.below(10)) {
        case 0: {
            glm::dvec3 axis(0.0);
            axis[draw.below(3)] = draw.chance(0.5) ? 1.0 : -1.0;
            return axis;
        }
        case 1: return unit(corner);
        case 2: return unit(-corner);
        case 3: return unit(glm::cross(unit(corner), draw.direction()));
        case 4: return unit(glm::cross(unit(middle), draw.direction()));
        default: return draw.direction();
    }
}

/// Extended precision, for values that bounds are compared with.
struct Exact {
    long double x, y, z;

    explicit Exact(const glm::dvec3& v) : x(v.x), y(v.y), z(v.z) {}
    Exact(const glm::vec3& light, const glm::vec3& receiver)
        : x(static_cast<long double>(light.x) - receiver.x), y(static_cast<long double>(light.y) - receiver.y),
          z(static_cast<long double>(light.z) - receiver.z) {}

    friend long double dot(const Exact& a, const Exact& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
};

/// A light of the box: a corner, a point of a face or edge, or one inside.
inline glm::vec3 light_in(const lightcuts::Box& box, Draw& draw) {
    glm::vec3 p;
    for (int i = 0; i < 3; ++i) {
        const int side = draw.below(3);
        const double t = side == 0 ? 0.0 : side == 1 ? 1.0 : draw.unit();
        const float inside = static_cast<float>(static_cast<double>(box.lo[i]) * (1.0 - t) +
                                                static_cast<double>(box.hi[i]) * t);
        p[i] = inside < box.lo[i] ? box.lo[i] : inside > box.hi[i] ? box.hi[i] : inside;
    }
    return p;
}

/// A point on the path that the maxima of v.p / |p|^k lie on, for all k: the projections of s v on the box.
inline glm::dvec3 likely_maximum(const glm::dvec3& v, const lightcuts::OffsetBox& box, Draw& draw) {
    const double size = std::sqrt(max_distance2(box));
    return clamp(v * (size * std::exp(draw.uniform(-4.0, 4.0))), box);
}

}  // namespace configurations
