#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <lightcuts/core/invalid_input.hpp>
#include <lightcuts/tree/build/item.hpp>

#include "support/random.hpp"

namespace lightcuts::test {

/// Oriented items of a random kind: positions, weights and axes are each drawn from ordinary and degenerate families.
struct ItemSet {
    std::string name;
    std::vector<OrientedItem> items;
};

inline ItemSet random_items(Random& random, std::size_t count) {
    static constexpr std::array positions{"volume", "grid", "line", "plane", "point", "far and uneven", "sphere"};
    static constexpr std::array weights{"equal", "similar", "over 60 decades", "tiny or huge"};
    static constexpr std::array axes{"any", "equal",        "along x, y, z", "jittered",
                                     "few", "almost equal", "as position",   "hardly jittered"};
    const std::size_t position = random.below(positions.size());
    const std::size_t weight = random.below(weights.size());
    const std::size_t axis = random.below(axes.size());
    const auto step = [&](std::size_t n) { return static_cast<float>(random.below(n)); };
    ItemSet set;
    set.name = std::to_string(count) + " items; positions: " + positions[position] + "; weights: " + weights[weight] +
               "; axes: " + axes[axis];
    for (std::size_t i = 0; i < count; ++i) {
        OrientedItem item{};
        const glm::vec3 direction(random.on_sphere());
        switch (position) {
            case 0: item.position = glm::vec3(random.in_box(glm::dvec3(-1.0), glm::dvec3(2.0))); break;
            case 1: item.position = {step(4), step(4), step(4)}; break;
            case 2: item.position = {random.real(0, 1), 0, 0}; break;
            case 3: item.position = {random.real(0, 1), random.real(0, 1), 3}; break;
            case 4: item.position = {1, 2, 3}; break;
            case 5: item.position = {1e6f + step(3), step(5), std::exp2(step(30))}; break;
            default: item.position = direction; break;
        }
        switch (weight) {
            case 0: item.weight = 1; break;
            case 1: item.weight = random.real(0.5, 1.5); break;
            case 2: item.weight = static_cast<float>(random.decades(-30, 30)); break;
            default: item.weight = random.chance(0.5) ? 1e-30f : 1e30f; break;
        }
        switch (axis) {
            case 0: item.axis = glm::vec3(random.on_sphere()); break;
            case 1: item.axis = {0, 0, 1}; break;
            case 2: item.axis[static_cast<int>(random.below(3))] = random.chance(0.5) ? 1.0f : -1.0f; break;
            case 3: item.axis = glm::vec3(random.near({0, 1, 0}, 0.1)); break;
            case 4: item.axis = glm::normalize(glm::vec3(step(3) - 1, step(3) - 1, step(2) - 0.5f)); break;
            case 5: item.axis = {0, 0, random.chance(0.5) ? 1.0f : 0.9999999f}; break;
            case 6: item.axis = direction; break;
            default: item.axis = glm::vec3(random.near({0.6, 0, 0.8}, 1e-3)); break;
        }
        set.items.push_back(item);
    }
    return set;
}

inline std::vector<PointItem> without_axes(const std::vector<OrientedItem>& items) {
    std::vector<PointItem> points;
    for (const OrientedItem& i : items) points.push_back({i.position, i.weight});
    return points;
}

/// Lights all over the walls of a room, which is turned so that no wall is aligned with an axis.
inline std::vector<OrientedItem> room_items(Random& random, std::size_t count, double jitter) {
    const glm::vec3 size(20, 6, 12);
    const auto turn = [](const glm::vec3& v) {
        const float c = std::cos(0.7f), s = std::sin(0.7f);
        const glm::vec3 w(c * v.x - s * v.y, s * v.x + c * v.y, v.z);
        return glm::vec3(w.x, c * w.y - s * w.z, s * w.y + c * w.z);
    };
    std::vector<OrientedItem> items;
    for (std::size_t i = 0; i < count; ++i) {
        const int side = static_cast<int>(random.below(3));
        const bool far = random.chance(0.5);
        glm::vec3 p(random.in_box(glm::dvec3(0.0), glm::dvec3(size)));
        glm::vec3 normal(0);
        p[side] = far ? size[side] : 0.0f;
        normal[side] = far ? -1.0f : 1.0f;
        items.push_back(
            {turn(p), glm::vec3(random.near(glm::normalize(glm::dvec3(turn(normal))), jitter)), random.real(0.1, 1.1)});
    }
    return items;
}

/// An executor of two threads, which take every other task.
struct TwoThreads {
    template <class Task>
    void operator()(std::size_t count, Task&& task) const {
        const auto half = [&](std::size_t first) {
            for (std::size_t i = first; i < count; i += 2) task(i);
        };
        std::thread other(half, 1);
        half(0);
        other.join();
    }
};

/// An executor that runs its tasks in the wrong order.
struct Backwards {
    template <class Task>
    void operator()(std::size_t count, Task&& task) const {
        for (std::size_t i = count; i-- > 0;) task(i);
    }
};

/// The message of the invalid_input that `f()` throws, or nothing.
template <class F>
std::string refusal(F&& f) {
    try {
        f();
    } catch (const invalid_input& error) { return error.what(); }
    return {};
}

}  // namespace lightcuts::test
