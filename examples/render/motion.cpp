#include "motion.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <lightcuts/core/assertion.hpp>

#include "bounding_box.hpp"

namespace render {

namespace {

/// As many as the ray tracer takes.
constexpr std::uint32_t most_steps = 128;
/// Steps times vertices of a part, at most: a gigabyte.
constexpr std::size_t most_vertices = std::size_t{1} << 25;
/// How far vertices may be off their path, as a share of their extent.
constexpr double tolerance = 1.0 / 4000.0;

/// The frames of a path at multiples of 1 / most_steps, each computed once.
class Frames {
public:
    explicit Frames(const VertexPath& path) : path_(path) {}

    static constexpr std::uint32_t last = most_steps;

    const VertexFrame& at(std::uint32_t place) {
        const auto known = frames_.find(place);
        if (known != frames_.end()) return known->second;
        return frames_.emplace(place, path_(static_cast<double>(place) / last)).first->second;
    }

    /// How far any vertex is from the middle of its way, where that takes `steps` straight steps. pre: steps < last.
    double deviation(std::uint32_t steps) {
        const std::uint32_t stride = last / steps;
        double largest = 0.0;
        for (std::uint32_t begin = 0; begin < last; begin += stride) {
            const VertexFrame& a = at(begin);
            const VertexFrame& b = at(begin + stride);
            const VertexFrame& middle = at(begin + stride / 2);
            for (std::size_t v = 0; v < a.positions.size(); ++v) {
                const glm::dvec3 straight = 0.5 * (glm::dvec3(a.positions[v]) + glm::dvec3(b.positions[v]));
                largest = std::max(largest, glm::length(glm::dvec3(middle.positions[v]) - straight));
            }
        }
        return largest;
    }

    bool all_equal() const {
        const VertexFrame& first = frames_.begin()->second;
        return std::all_of(frames_.begin(), frames_.end(), [&](const auto& frame) {
            return frame.second.positions == first.positions && frame.second.normals == first.normals &&
                   frame.second.tangents == first.tangents;
        });
    }

private:
    const VertexPath& path_;
    std::map<std::uint32_t, VertexFrame> frames_;
};

template <class V>
void append(std::vector<V>& to, const std::vector<V>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

/// Where `time` lies among a part's steps.
struct Between {
    std::size_t step;
    double after;  ///< 0 at the step, 1 at the next

    Between(const MovingVertices& part, float time) {
        const double place = std::clamp(static_cast<double>(time), 0.0, 1.0) * (part.steps - 1);
        step = std::min(static_cast<std::size_t>(place), static_cast<std::size_t>(part.steps) - 2);
        after = place - static_cast<double>(step);
    }
};

/// Of the part's `list`, in doubles.
template <class Double, class V>
Double value_at(const MovingVertices& part, const std::vector<V>& list, std::uint32_t vertex, float time) {
    const Between between(part, time);
    const std::size_t at = between.step * part.count + (vertex - part.first);
    return (1.0 - between.after) * Double(list[at]) + between.after * Double(list[at + part.count]);
}

glm::dvec3 position_at(const Scene& scene, std::uint32_t vertex, float time) {
    const MovingVertices* part = motion_of(scene, vertex);
    return part ? value_at<glm::dvec3>(*part, part->positions, vertex, time) : glm::dvec3(scene.positions[vertex]);
}

/// Where `motion` has at `second` what is at `original` at second 0.
glm::vec3 moved(const RigidMotion& motion, const glm::dmat3& turn, const glm::vec3& original, double second) {
    return glm::vec3(motion.center + turn * (glm::dvec3(original) - motion.center) + motion.velocity * second);
}

glm::dmat3 turn_at(const RigidMotion& motion, double second) {
    return glm::dmat3(glm::rotate(glm::dmat4(1.0), motion.turn * second, motion.axis));
}

/// Of the vertices of `motion`, whose place at second 0 is `original`, at `second`.
VertexFrame frame_of(const RigidMotion& motion, const VertexFrame& original, double second) {
    const glm::dmat3 turn = turn_at(motion, second);
    VertexFrame frame = original;
    for (glm::vec3& p : frame.positions) p = moved(motion, turn, p, second);
    for (glm::vec3& n : frame.normals) n = glm::vec3(turn * glm::dvec3(n));
    for (glm::vec4& t : frame.tangents) t = glm::vec4(glm::vec3(turn * glm::dvec3(t)), t.w);
    return frame;
}

template <class V>
std::vector<V> part_of(const std::vector<V>& all, const RigidMotion& motion) {
    if (all.empty()) return {};
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(motion.first_vertex);
    return std::vector<V>(begin, begin + static_cast<std::ptrdiff_t>(motion.vertex_count));
}

template <class V>
void put_back(std::vector<V>& all, const std::vector<V>& part, const RigidMotion& motion) {
    std::copy(part.begin(), part.end(), all.begin() + static_cast<std::ptrdiff_t>(motion.first_vertex));
}

/// Puts the spherical lights of all parts where they are as the shutter opens; those that move while it is open become
/// one for each instant.
void move_spheres(Scene& scene, const Shutter& shutter) {
    const std::vector<float> times = shutter.is_moment() ? std::vector<float>{} : times_of_instants(shutter);
    std::vector<lightcuts::SphereLight<>> still = scene.spheres;
    std::vector<bool> moves(scene.spheres.size(), false);
    for (const RigidMotion& motion : scene.rigid_motions) {
        LIGHTCUTS_ASSERT(motion.sphere_count <= scene.spheres.size() &&
                         motion.first_sphere <= scene.spheres.size() - motion.sphere_count);
        for (std::uint32_t i = motion.first_sphere; i < motion.first_sphere + motion.sphere_count; ++i) {
            const lightcuts::SphereLight<> original = scene.spheres[i];
            const auto center_at = [&](double second) {
                return moved(motion, turn_at(motion, second), original.center, second);
            };
            if (shutter.opens != 0.0) still[i].center = center_at(shutter.opens);
            LIGHTCUTS_ASSERT(!moves[i]);
            moves[i] = motion.turn != 0.0 || motion.velocity != glm::dvec3(0.0);
            if (!moves[i]) continue;
            for (std::uint32_t t = 0; t < times.size(); ++t) {
                lightcuts::SphereLight<> there = original;
                there.center = center_at(shutter.second_at(static_cast<double>(times[t])));
                scene.at_instants.spheres.push_back({there, t});
            }
        }
    }
    scene.spheres.clear();
    for (std::size_t i = 0; i < still.size(); ++i) {
        if (shutter.is_moment() || !moves[i]) scene.spheres.push_back(still[i]);
    }
}

}  // namespace

void add_motion(Scene& scene, std::uint32_t first, std::uint32_t count, std::uint32_t least_steps,
                const VertexPath& path) {
    if (count == 0) return;
    Frames frames(path);
    const auto limit = static_cast<std::uint32_t>(
        std::clamp<std::size_t>(std::bit_floor(most_vertices / count), 1, most_steps));
    std::uint32_t steps = std::min(std::bit_ceil(std::clamp(least_steps, 1u, most_steps)), limit);
    const double largest = tolerance * std::sqrt(lightcuts::diagonal2(bounding_box(frames.at(0).positions)));
    while (steps < limit && frames.deviation(steps) > largest) steps *= 2;
    for (std::uint32_t step = 0; step <= steps; ++step) frames.at(step * (Frames::last / steps));
    if (frames.all_equal()) return;
    if (least_steps > limit) {
        leave_out(scene.left_out, "the exact path of what moves fast or to and fro",
                  std::to_string(limit) + " straight steps are fewer than it has quarter turns or keys");
    }
    MovingVertices part;
    part.first = first;
    part.count = count;
    part.steps = steps + 1;
    for (std::uint32_t step = 0; step <= steps; ++step) {
        const VertexFrame& frame = frames.at(step * (Frames::last / steps));
        append(part.positions, frame.positions);
        append(part.normals, frame.normals);
        append(part.tangents, frame.tangents);
    }
    scene.moving.push_back(std::move(part));
}

void apply_rigid_motions(Scene& scene, const Shutter& shutter) {
    std::sort(scene.rigid_motions.begin(), scene.rigid_motions.end(),
              [](const RigidMotion& a, const RigidMotion& b) { return a.first_vertex < b.first_vertex; });
    for (const RigidMotion& motion : scene.rigid_motions) {
        const VertexFrame original{part_of(scene.positions, motion), part_of(scene.normals, motion),
                                   part_of(scene.tangents, motion)};
        const VertexFrame opening = shutter.opens == 0.0 ? original : frame_of(motion, original, shutter.opens);
        put_back(scene.positions, opening.positions, motion);
        put_back(scene.normals, opening.normals, motion);
        put_back(scene.tangents, opening.tangents, motion);
        if (shutter.is_moment()) continue;
        // No more than a quarter turn at a time.
        const double quarters = std::abs(motion.turn) * shutter.seconds / (0.5 * std::numbers::pi);
        const auto least_steps = static_cast<std::uint32_t>(std::min(std::ceil(quarters), 1e9));
        add_motion(scene, motion.first_vertex, motion.vertex_count, least_steps, [&](double time) {
            return time == 0.0 ? opening : frame_of(motion, original, shutter.second_at(time));
        });
    }
    move_spheres(scene, shutter);
    scene.rigid_motions.clear();
}

void set_instants(Scene& scene, const Shutter& shutter) {
    const bool camera_moves = std::any_of(scene.cameras.begin(), scene.cameras.end(),
                                          [](const Camera& camera) { return !camera.at_instants.empty(); });
    if (!scene.moving.empty() || scene.at_instants.count() > 0 || !scene.at_instants.spheres.empty() || camera_moves) {
        scene.instants = times_of_instants(shutter);
    }
}

const MovingVertices* motion_of(const Scene& scene, std::uint32_t vertex) {
    if (scene.moving.empty()) return nullptr;
    const auto after = std::upper_bound(scene.moving.begin(), scene.moving.end(), vertex,
                                        [](std::uint32_t v, const MovingVertices& part) { return v < part.first; });
    if (after == scene.moving.begin() || !std::prev(after)->contains(vertex)) return nullptr;
    return &*std::prev(after);
}

Triangle triangle_at(const Scene& scene, std::uint32_t triangle, float time) {
    if (!moves(scene, triangle)) return Triangle(scene, triangle);
    const glm::uvec3& t = scene.triangles[triangle];
    const std::array<glm::dvec3, 3> corners{position_at(scene, t.x, time), position_at(scene, t.y, time),
                                            position_at(scene, t.z, time)};
    return Triangle(corners, glm::uvec3(0, 1, 2));
}

std::array<glm::vec3, 3> normals_at(const Scene& scene, std::uint32_t triangle, float time) {
    const glm::uvec3& t = scene.triangles[triangle];
    const MovingVertices* part = motion_of(scene, t.x);
    const auto at = [&](std::uint32_t v) {
        return part ? glm::vec3(value_at<glm::dvec3>(*part, part->normals, v, time)) : scene.normals[v];
    };
    return {at(t.x), at(t.y), at(t.z)};
}

std::array<glm::vec4, 3> tangents_at(const Scene& scene, std::uint32_t triangle, float time) {
    const glm::uvec3& t = scene.triangles[triangle];
    const MovingVertices* part = motion_of(scene, t.x);
    const auto at = [&](std::uint32_t v) {
        return part ? glm::vec4(value_at<glm::dvec4>(*part, part->tangents, v, time)) : scene.tangents[v];
    };
    return {at(t.x), at(t.y), at(t.z)};
}

}  // namespace render
