#pragma once

#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include <render/scene.hpp>

/// Scenes for tests, of opaque quads; y is up.
class Room {
public:
    Room() {
        scene_.name = "room";
        scene_.materials.resize(1);
    }
    Room& quad(glm::vec3 a, glm::vec3 b, glm::vec3 c, glm::vec3 d) {
        const auto first = static_cast<std::uint32_t>(scene_.positions.size());
        scene_.positions.insert(scene_.positions.end(), {a, b, c, d});
        for (const glm::uvec3 t : {glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)}) {
            scene_.triangles.push_back(t + first);
            scene_.triangle_material.push_back(0);
        }
        return *this;
    }
    Room& box(glm::vec3 lo, glm::vec3 hi) {
        for (int axis = 0; axis < 3; ++axis) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            for (const float at : {lo[axis], hi[axis]}) {
                glm::vec3 corner[4];
                for (int k = 0; k < 4; ++k) {
                    corner[k][axis] = at;
                    corner[k][u] = k == 1 || k == 2 ? hi[u] : lo[u];
                    corner[k][v] = k >= 2 ? hi[v] : lo[v];
                }
                quad(corner[0], corner[1], corner[2], corner[3]);
            }
        }
        return *this;
    }
    const render::Scene& scene() const { return scene_; }
    render::Scene& scene() { return scene_; }

private:
    render::Scene scene_;
};

/// Level ground, far and wide below.
inline Room open_field() {
    Room room;
    room.quad({-500, -1, -500}, {-500, -1, 500}, {500, -1, 500}, {500, -1, -500});
    return room;
}

/// A shed of 6 x 3 x 6 without a wall to the south, and a post before it.
inline Room open_shed() {
    Room room = open_field();
    room.quad({-3, 3, -3}, {-3, 3, 3}, {3, 3, 3}, {3, 3, -3});
    room.quad({-3, -1, -3}, {-3, 3, -3}, {3, 3, -3}, {3, -1, -3});
    room.quad({-3, -1, -3}, {-3, 3, -3}, {-3, 3, 3}, {-3, -1, 3});
    room.quad({3, -1, -3}, {3, 3, -3}, {3, 3, 3}, {3, -1, 3});
    room.box({0.2f, -1, 2.5f}, {0.8f, 3, 2.8f});
    return room;
}
