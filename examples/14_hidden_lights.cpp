// A mesh of your own proves that lights are hidden, without a ray tracer of ours: a corridor of rooms with a lamp field
// in each. From a point in one room nearly all lamps are behind walls; a cluster that is proved to be hidden is not
// refined, and costs no shadow ray.
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <span>
#include <vector>

#include <glm/geometric.hpp>
#include <lightcuts/lightcuts.hpp>
#include <lightcuts/visibility/proving_oracle.hpp>

namespace {

using Corners = std::array<glm::vec3, 3>;

constexpr int rooms = 8;

// Walls across the corridor with a door in each, of triangles that share their corners.
std::vector<Corners> make_walls() {
    std::vector<Corners> walls;
    for (int wall = 1; wall < rooms; ++wall) {
        for (int y = 0; y < 4; ++y) {
            for (int z = 0; z < 3; ++z) {
                const bool is_door = z < 2 && y == (wall % 2 == 0 ? 0 : 3);
                if (is_door) continue;
                const auto corner = [&](int i, int k) { return glm::vec3(4 * wall, y + i, z + k); };
                walls.push_back({corner(0, 0), corner(1, 0), corner(1, 1)});
                walls.push_back({corner(0, 0), corner(1, 1), corner(0, 1)});
            }
        }
    }
    return walls;
}

// The first triangle that a segment meets, by asking all: stands for the ray tracer that you have.
struct Walls {
    std::span<const Corners> triangles;

    lightcuts::OccluderMesh::Index first(const glm::vec3& from, const glm::vec3& to) const {
        lightcuts::OccluderMesh::Index found = lightcuts::OccluderMesh::no_triangle;
        double nearest = 1.0;
        const glm::dvec3 way = glm::dvec3(to) - glm::dvec3(from);
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            const glm::dvec3 a = glm::dvec3(triangles[i][0]) - glm::dvec3(from);
            const glm::dvec3 b = glm::dvec3(triangles[i][1]) - glm::dvec3(from);
            const glm::dvec3 c = glm::dvec3(triangles[i][2]) - glm::dvec3(from);
            const double u = glm::dot(glm::cross(a, b), way), v = glm::dot(glm::cross(b, c), way),
                         w = glm::dot(glm::cross(c, a), way);
            if (!((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0)) || u + v + w == 0) continue;
            const glm::dvec3 normal = glm::cross(b - a, c - a);
            const double at = glm::dot(normal, a) / glm::dot(normal, way);
            if (at > 0.0 && at < nearest) {
                nearest = at;
                found = static_cast<lightcuts::OccluderMesh::Index>(i);
            }
        }
        return found;
    }
    // What a proof asks for.
    lightcuts::OccluderMesh::Index operator()(const lightcuts::VisibilityQuery& query) const {
        return first(query.from, query.to);
    }
};

// A visibility oracle as of any renderer.
struct Visible {
    const Walls& walls;

    template <class Receiver, class Light>
    bool operator()(const Receiver& receiver, const Light& light) const {
        return walls.first(receiver.shadow_origin, light.position) == lightcuts::OccluderMesh::no_triangle;
    }
};

}  // namespace

int main() {
    std::mt19937 random(1);
    const auto uniform = [&](float lo, float hi) { return std::uniform_real_distribution<float>(lo, hi)(random); };
    std::vector<lightcuts::OmniLight<>> lamps(20'000);
    for (auto& lamp : lamps) {
        lamp.position = {uniform(0.1f, 4 * rooms - 0.1f), uniform(0.1f, 3.9f), uniform(2.2f, 2.8f)};
        lamp.intensity = glm::vec3(uniform(0.5f, 1.5f));  // W/sr
    }
    const lightcuts::LightTree tree(lamps);

    const std::vector<Corners> triangles = make_walls();
    const lightcuts::OccluderMesh mesh(triangles.size(), [&](std::size_t i) { return triangles[i]; });
    const Walls walls{triangles};
    const lightcuts::HiddenLights<Walls> hidden(mesh, walls);
    const Visible plain{walls};
    // The same with proofs.
    const lightcuts::ProvingOracle proving(plain, hidden);

    double cut = 0, rays = 0, proved_cut = 0, proved_rays = 0, difference = 0, total = 0;
    constexpr int points = 64;
    for (int i = 0; i < points; ++i) {
        const lightcuts::Lambert floor{glm::vec3(0.0f, 0.0f, 1.0f), glm::vec3(0.5f)};
        const lightcuts::Receiver receiver(glm::vec3(uniform(0.2f, 31.8f), uniform(0.2f, 3.8f), 0.01f), floor);
        const auto without = lightcuts::shade(tree, receiver, plain, {.max_cut = 0});
        const auto with = lightcuts::shade(tree, receiver, proving, {.max_cut = 0});
        cut += without.cut_size;
        rays += without.queries;
        proved_cut += with.cut_size;
        proved_rays += with.queries;
        const auto exact = lightcuts::exhaustive(tree, receiver, plain);
        difference += static_cast<double>(std::abs(with.radiance.r - exact.radiance.r));
        total += static_cast<double>(exact.radiance.r);
    }
    std::printf(
        "a point, without proofs: %.0f clusters, %.0f shadow rays; with proofs: %.0f clusters, %.0f shadow rays\n"
        "%.2f %% from the sum over all lamps\n",
        cut / points, rays / points, proved_cut / points, proved_rays / points, 100.0 * difference / total);
    return proved_cut < 0.8 * cut && difference < 0.02 * total ? 0 : 1;
}
