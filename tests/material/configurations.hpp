#pragma once

#include <cmath>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <lightcuts/core/box.hpp>
#include <lightcuts/core/random.hpp>
#include <lightcuts/material/material.hpp>

namespace material_test {

/// A stream of random numbers, the same on every platform.
class Numbers {
public:
    explicit Numbers(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() { return lightcuts::mix_bits(state_++); }
    int below(int n) { return static_cast<int>(bits() % static_cast<std::uint64_t>(n)); }
    double uniform(double lo = 0.0, double hi = 1.0) { return lo + (hi - lo) * lightcuts::uniform01(bits()); }
    /// Uniform in the logarithm.
    double magnitude(double lo, double hi) { return lo * std::exp(uniform() * std::log(hi / lo)); }
    glm::dvec3 cube() { return {uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0)}; }
    glm::dvec3 direction() {
        for (;;) {
            const glm::dvec3 p = cube();
            const double r2 = glm::dot(p, p);
            if (r2 > 1e-4 && r2 < 1.0) return p / std::sqrt(r2);
        }
    }

private:
    std::uint64_t state_;
};

struct Surface {
    glm::vec3 normal;
    glm::vec3 view;
};

inline glm::vec3 unit(const glm::dvec3& v) { return glm::vec3(glm::normalize(v)); }

/// Random, axis-aligned, head-on and grazing views, down to a cosine of 1e-6.
inline Surface random_surface(Numbers& numbers) {
    glm::dvec3 n = numbers.direction();
    if (numbers.below(3) == 0) {
        n = glm::dvec3(0.0);
        n[numbers.below(3)] = numbers.below(2) == 0 ? 1.0 : -1.0;
    }
    const glm::dvec3 tangent = glm::normalize(glm::cross(n, numbers.direction()));
    const double cosine = [&] {
        switch (numbers.below(5)) {
            case 0: return 1.0;
            case 1: return numbers.magnitude(1e-6, 0.1);
            case 2: return 1.0 - numbers.magnitude(1e-12, 1e-2);
            default: return numbers.uniform(0.05, 1.0);
        }
    }();
    return {unit(n), unit(n * cosine + tangent * std::sqrt((1.0 - cosine) * (1.0 + cosine)))};
}

inline glm::dvec3 mirror_of(const Surface& s) {
    const glm::dvec3 n = glm::normalize(glm::dvec3(s.normal));
    const glm::dvec3 v = glm::normalize(glm::dvec3(s.view));
    return glm::normalize(2.0 * glm::dot(n, v) * n - v);
}

/// Boxes of every sort that has ever broken a bound: flat, needles, points, touching or holding the receiver, astride
/// the horizon, about the mirror direction, about the viewer or behind it, tiny and huge.
inline lightcuts::OffsetBox random_box(Numbers& numbers, const Surface& s) {
    const glm::dvec3 n(s.normal);
    const glm::dvec3 v(s.view);
    glm::dvec3 center = numbers.direction();
    switch (numbers.below(6)) {
        case 0: center = mirror_of(s); break;
        case 1: center = mirror_of(s) + numbers.magnitude(1e-7, 1.0) * numbers.direction(); break;
        case 2: center = numbers.below(2) == 0 ? v : -v; break;
        case 3: {
            const double above = numbers.magnitude(1e-9, 0.1);
            center -= n * (glm::dot(n, center) - (numbers.below(4) == 0 ? -above : above));
            break;
        }
        default: break;
    }
    glm::dvec3 half = glm::abs(numbers.cube()) * numbers.magnitude(1e-7, 2.0);
    switch (numbers.below(8)) {
        case 0: half[numbers.below(3)] = 0.0; break;
        case 1: {
            const int axis = numbers.below(3);
            for (int i = 0; i < 3; ++i) half[i] = i == axis ? half[i] : 0.0;
            break;
        }
        case 2: half = glm::dvec3(0.0); break;
        case 3: half[numbers.below(3)] *= 1e6; break;
        case 4: center = numbers.cube() * half; break;
        default: break;
    }
    lightcuts::OffsetBox box{center - half, center + half};
    if (numbers.below(10) == 0) {
        const int axis = numbers.below(3);
        (numbers.below(2) == 0 ? box.lo : box.hi)[axis] = 0.0;
        if (box.lo[axis] > box.hi[axis]) box.lo[axis] = box.hi[axis] = 0.0;
    }
    const double scale = numbers.below(4) == 0 ? numbers.magnitude(1e-12, 1e12) : 1.0;
    return {box.lo * scale, box.hi * scale};
}

/// The direction that evaluate() is given for an offset.
inline glm::vec3 as_given(const glm::dvec3& p) {
    const double largest = std::fmax(std::fabs(p.x), std::fmax(std::fabs(p.y), std::fabs(p.z)));
    return glm::normalize(glm::vec3(p / largest));
}

/// The quick bound of one box.
template <class M>
auto quick_bound(const M& m, const lightcuts::OffsetBox& box) {
    lightcuts::OffsetBlock block;
    block.set(0, glm::vec3(box.lo), glm::vec3(box.hi));
    block.finish(1);
    lightcuts::LaneSpectra<lightcuts::material_spectrum<M>> bounds;
    lightcuts::cheapest_upper_bounds(m, block, bounds);
    return bounds[0];
}

/// What `evaluate_many` returns, or its equivalent, for one direction.
template <class M>
auto value_in_lane(const M& m, const glm::vec3& to_light) {
    lightcuts::LaneVectors directions;
    directions.set(0, to_light);
    lightcuts::detail::repeat_last(directions, 1);
    lightcuts::LaneSpectra<lightcuts::material_spectrum<M>> values;
    lightcuts::evaluate_lanes(m, directions, 1, values);
    return values[0];
}

/// Calls f(p) for points of the box: vertices, faces, interior, those nearest to the rays along `aims`, and then ever
/// closer to the point for which f returned most. Returns that most.
template <class F, class Aims>
double search_maximum(Numbers& numbers, const lightcuts::OffsetBox& box, const Aims& aims, int points, const F& f) {
    double most = 0.0;
    glm::dvec3 where = 0.5 * (box.lo + box.hi);
    const auto visit = [&](const glm::dvec3& p) {
        if (p == glm::dvec3(0.0)) return;
        const double value = f(p);
        if (value > most) {
            most = value;
            where = p;
        }
    };
    for (int i = 0; i < 8; ++i) {
        visit({(i & 1) != 0 ? box.hi.x : box.lo.x, (i & 2) != 0 ? box.hi.y : box.lo.y,
               (i & 4) != 0 ? box.hi.z : box.lo.z});
    }
    const double far = glm::length(where);
    for (const glm::dvec3& aim : aims) {
        for (const double reach : {0.5, 1.0, 2.0}) visit(lightcuts::clamp(aim * (far * reach), box));
    }
    for (int i = 0; i < points / 2; ++i) {
        glm::dvec3 p = box.lo + (box.hi - box.lo) * glm::dvec3(numbers.uniform(), numbers.uniform(), numbers.uniform());
        if (i % 2 == 0) {
            const int axis = numbers.below(3);
            p[axis] = numbers.below(2) == 0 ? box.lo[axis] : box.hi[axis];
        }
        visit(lightcuts::clamp(p, box));
    }
    double radius = 0.5;
    for (int i = 0; i < points / 2; ++i, radius *= 0.8) {
        visit(lightcuts::clamp(where + radius * numbers.cube() * (box.hi - box.lo), box));
    }
    return most;
}

/// A user's spectrum.
struct Bands {
    static constexpr int channels = 5;
    float value[channels] = {};

    float operator[](int i) const { return value[i]; }
    float& operator[](int i) { return value[i]; }
    friend Bands operator+(const Bands& a, const Bands& b) {
        Bands r;
        for (int i = 0; i < channels; ++i) r[i] = a[i] + b[i];
        return r;
    }
    friend Bands operator*(const Bands& a, const Bands& b) {
        Bands r;
        for (int i = 0; i < channels; ++i) r[i] = a[i] * b[i];
        return r;
    }
    friend Bands operator*(const Bands& a, float k) {
        Bands r;
        for (int i = 0; i < channels; ++i) r[i] = a[i] * k;
        return r;
    }
};

}  // namespace material_test
