#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <lightcuts/light/incidence.hpp>
#include <lightcuts/visibility/query.hpp>
#include "support/random.hpp"

namespace lightcuts::test {

/// Triangles and spheres that cast shadows, tested one after the other.
class Occluders {
public:
    void add_triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        triangles_.push_back({a, b, c});
    }
    void add_sphere(const glm::dvec3& center, double radius) { spheres_.push_back({center, radius}); }

    /// True if something stands between `from` and the point `to`, or in the direction `to`.
    bool block(const glm::vec3& from, const glm::vec3& to, bool distant) const {
        const glm::dvec3 origin(from);
        const glm::dvec3 ray = distant ? glm::dvec3(to) : glm::dvec3(to) - origin;
        const double end = distant ? 1e30 : 1.0 - 1e-6;
        for (const Triangle& t : triangles_) {
            if (hits(t, origin, ray, end)) return true;
        }
        for (const Sphere& s : spheres_) {
            if (hits(s, origin, ray, end)) return true;
        }
        return false;
    }

private:
    struct Triangle {
        glm::dvec3 a, b, c;
    };
    struct Sphere {
        glm::dvec3 center;
        double radius;
    };

    /// [Möller and Trumbore 1997]
    static bool hits(const Triangle& t, const glm::dvec3& origin, const glm::dvec3& ray, double end) {
        const glm::dvec3 ab = t.b - t.a, ac = t.c - t.a;
        const glm::dvec3 p = glm::cross(ray, ac);
        const double determinant = glm::dot(ab, p);
        if (determinant == 0.0) return false;
        const glm::dvec3 s = origin - t.a;
        const double u = glm::dot(s, p) / determinant;
        const glm::dvec3 q = glm::cross(s, ab);
        const double v = glm::dot(ray, q) / determinant;
        const double along = glm::dot(ac, q) / determinant;
        return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && along > 1e-9 && along < end;
    }
    static bool hits(const Sphere& s, const glm::dvec3& origin, const glm::dvec3& ray, double end) {
        const glm::dvec3 o = origin - s.center;
        const double a = glm::dot(ray, ray), b = glm::dot(o, ray), c = glm::dot(o, o) - s.radius * s.radius;
        const double d = b * b - a * c;
        if (d < 0.0) return false;
        const double root = std::sqrt(d);
        const double near = (-b - root) / a, far = (-b + root) / a;
        return (near > 1e-9 && near < end) || (far > 1e-9 && far < end);
    }

    std::vector<Triangle> triangles_;
    std::vector<Sphere> spheres_;
};

/// Asks about one light at a time. `through`: what a blocked ray still lets pass.
struct ScalarOccluders {
    const Occluders& occluders;
    float through = 0.0f;

    template <class R, Light L>
    float operator()(const R& receiver, const L& light) const {
        return occluders.block(receiver.shadow_origin, position_or_direction(light), DirectionalLight<L>) ? through
                                                                                                          : 1.0f;
    }
};

/// The same, asked about many lights at once only.
struct BatchedOccluders {
    const Occluders& occluders;
    float through = 0.0f;

    void many(std::span<const VisibilityQuery> queries, std::span<float> answers) const {
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const VisibilityQuery& q = queries[i];
            answers[i] = occluders.block(q.from, q.to, q.distant) ? through : 1.0f;
        }
    }
};

}  // namespace lightcuts::test
