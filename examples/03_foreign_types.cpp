// Lights and vectors of somebody else, whose headers cannot be edited: traits tell the library how to read them.
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include <lightcuts/lightcuts.hpp>

// What another engine's headers say: a vector without x, y, z; a lamp with accessors of other names.
namespace engine {

class Vector {
public:
    Vector(double a, double b, double c) : c_{a, b, c} {}
    double operator[](std::size_t i) const { return c_[i]; }

private:
    std::array<double, 3> c_;
};

struct Color {
    unsigned char r, g, b;
};

class Lamp {
public:
    Lamp(const Vector& where, const Vector& facing, const Color& color, double watts)
        : where_(where), facing_(facing), color_(color), watts_(watts) {}
    const Vector& origin() const { return where_; }
    const Vector& facing() const { return facing_; }
    Color color() const { return color_; }
    double watts() const { return watts_; }

private:
    Vector where_, facing_;
    Color color_;
    double watts_;
};

}  // namespace engine

template <>
struct lightcuts::vector_traits<engine::Vector> {
    static float x(const engine::Vector& v) { return static_cast<float>(v[0]); }
    static float y(const engine::Vector& v) { return static_cast<float>(v[1]); }
    static float z(const engine::Vector& v) { return static_cast<float>(v[2]); }
};

// The functions are named after the concept's: with `axis` the lamp is an oriented light.
template <>
struct lightcuts::light_traits<engine::Lamp> {
    static engine::Vector position(const engine::Lamp& lamp) { return lamp.origin(); }
    static engine::Vector axis(const engine::Lamp& lamp) { return lamp.facing(); }
    static glm::vec3 intensity(const engine::Lamp& lamp) {
        // A lamp that emits W watts in proportion to the cosine sends W / pi along its axis.
        const engine::Color c = lamp.color();
        return static_cast<float>(lamp.watts() / (255.0 * 3.14159265)) * glm::vec3(c.r, c.g, c.b);
    }
};

int main() {
    // Lamps on the four walls of a room of 12 x 12 x 4 m, facing inwards.
    std::mt19937 random(2);
    const auto uniform = [&](double lo, double hi) { return std::uniform_real_distribution<>(lo, hi)(random); };
    const auto byte = [&] { return static_cast<unsigned char>(uniform(64, 255)); };
    std::vector<engine::Lamp> lamps;
    for (int i = 0; i < 50'000; ++i) {
        const double along = uniform(-6, 6), z = uniform(0.5, 4), side = i % 2 == 0 ? 1.0 : -1.0;
        const engine::Color color{byte(), byte(), byte()};
        if (i % 4 < 2) {
            lamps.emplace_back(engine::Vector(6 * side, along, z), engine::Vector(-side, 0, 0), color, 5);
        } else {
            lamps.emplace_back(engine::Vector(along, 6 * side, z), engine::Vector(0, -side, 0), color, 5);
        }
    }
    const lightcuts::LightTree tree(lamps);

    // Positions and normals of receivers are few: they are converted by `to_vec3`.
    const engine::Vector hit(1, 2, 0), normal(0, 0, 1);
    const lightcuts::Receiver floor(lightcuts::to_vec3(hit),
                                    lightcuts::Lambert{lightcuts::to_vec3(normal), glm::vec3(0.5f)});

    // An oracle gets the lamp as it is. A screen stands at x = 3, 1.5 m high.
    const auto visible = [&](const auto&, const engine::Lamp& lamp) {
        const engine::Vector& o = lamp.origin();
        const double t = (3.0 - hit[0]) / (o[0] - hit[0]);
        return !(t > 0.0 && t < 1.0 && hit[2] + t * (o[2] - hit[2]) < 1.5);
    };
    const auto shaded = lightcuts::shade(tree, floor, visible);
    const auto exact = lightcuts::exhaustive(tree, floor, visible);

    bool good = shaded.queries < 1000;
    for (int c = 0; c < 3; ++c) {
        const float error = std::fabs(shaded.radiance[c] - exact.radiance[c]);
        std::printf("%c: lightcut %8.1f   exhaustive %8.1f   off by %.2f %%\n", "rgb"[c], shaded.radiance[c],
                    exact.radiance[c], 100.0f * error / exact.radiance[c]);
        good = good && error <= shaded.error_bound[c] && error < 0.1f * exact.radiance[c];
    }
    std::printf("%u shadow rays instead of %u\n", shaded.queries, exact.queries);
    return good ? 0 : 1;
}
