#include "fine_mesh.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include <glm/geometric.hpp>
#include <lightcuts/core/invalid_input.hpp>

namespace relight {

namespace {

class EdgeSplitter {
public:
    EdgeSplitter(render::Scene& scene, double longest_edge) : scene_(scene), limit2_(longest_edge * longest_edge) {}

    double length2(std::uint32_t a, std::uint32_t b) const {
        const glm::dvec3 along = glm::dvec3(scene_.positions[a]) - glm::dvec3(scene_.positions[b]);
        return glm::dot(along, along);
    }
    bool is_short(double length2) const { return !(length2 > limit2_); }

    /// The vertex in the middle of an edge; the same for all triangles that share the edge's vertices.
    std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
        const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
        const auto [found, is_new] = middles_.try_emplace(key, static_cast<std::uint32_t>(scene_.positions.size()));
        if (is_new) {
            // Sums of two do not depend on their order: vertices in one place have their middles in one place, too.
            append(scene_.positions, a, b);
            append_direction(scene_.normals, a, b);
            append(scene_.tangents, a, b);
            append(scene_.colors, a, b);
            for (std::vector<glm::vec2>& uvs : scene_.uv_sets) append(uvs, a, b);
        }
        return found->second;
    }

private:
    template <class V>
    static void append(std::vector<V>& values, std::uint32_t a, std::uint32_t b) {
        if (!values.empty()) values.push_back((values[a] + values[b]) * 0.5f);
    }
    static void append_direction(std::vector<glm::vec3>& normals, std::uint32_t a, std::uint32_t b) {
        if (normals.empty()) return;
        const glm::vec3 sum = normals[a] + normals[b];
        const float length = glm::length(sum);
        // A zero normal asks for the face's.
        const bool is_there = normals[a] != glm::vec3(0.0f) && normals[b] != glm::vec3(0.0f) && length > 1e-6f;
        normals.push_back(is_there ? sum / length : glm::vec3(0.0f));
    }

    render::Scene& scene_;
    double limit2_;
    std::unordered_map<std::uint64_t, std::uint32_t> middles_;
};

}  // namespace

void refine_mesh(render::Scene& scene, double longest_edge, std::size_t most_triangles) {
    EdgeSplitter splitter(scene, longest_edge);
    std::vector<glm::uvec3> triangles;
    std::vector<std::uint32_t> materials;
    std::vector<glm::uvec3> open;
    for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
        open.assign(1, scene.triangles[t]);
        while (!open.empty()) {
            const glm::uvec3 now = open.back();
            open.pop_back();
            // Whichever edge is split first, an edge that is too long is split in the end, in its middle, by both of
            // its triangles. The longest first keeps triangles from becoming slivers.
            int longest = 0;
            double length2 = -1.0;
            for (int side = 0; side < 3; ++side) {
                const double own = splitter.length2(now[side], now[(side + 1) % 3]);
                if (own > length2) {
                    length2 = own;
                    longest = side;
                }
            }
            if (splitter.is_short(length2)) {
                triangles.push_back(now);
                materials.push_back(scene.triangle_material[t]);
                continue;
            }
            if (triangles.size() + open.size() >= most_triangles) {
                throw lightcuts::invalid_input(scene.name + ": edges of at most " + std::to_string(longest_edge) +
                                               " make more than " + std::to_string(most_triangles) +
                                               " triangles; give longer ones");
            }
            const std::uint32_t a = now[longest], b = now[(longest + 1) % 3], c = now[(longest + 2) % 3];
            const std::uint32_t m = splitter.middle(a, b);
            open.push_back({m, b, c});
            open.push_back({a, m, c});
        }
    }
    scene.triangles = std::move(triangles);
    scene.triangle_material = std::move(materials);
}

}  // namespace relight
