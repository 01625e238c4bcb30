#include "io/gltf_nodes.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <lightcuts/core/invalid_input.hpp>

namespace render {
namespace {

/// `m` with columns of unit length, as far as they have any.
glm::dmat3 without_scale(glm::dmat3 m) {
    for (int i = 0; i < 3; ++i) {
        const double length = glm::length(m[i]);
        if (length > 0.0) m[i] /= length;
    }
    return m;
}

/// The image of -z under the whole transform; where a scale of zero makes that the null vector, under the rotations
/// alone.
glm::dvec3 forward_under(const glm::dmat4& to_world, const glm::dmat3& turn) {
    const glm::dvec3 axis = -glm::dvec3(to_world[2]);
    const double length = glm::length(axis);
    const double rest = glm::length(turn[2]);
    return length > 0.0 ? axis / length : rest > 0.0 ? -turn[2] / rest : glm::dvec3(0.0);
}

}  // namespace

glm::dmat3 rotation_of(const double* q) {
    const glm::dquat quaternion(q[3], q[0], q[1], q[2]);
    return glm::length(quaternion) > 0.0 ? glm::mat3_cast(glm::normalize(quaternion)) : glm::dmat3(1.0);
}

GltfNodes::GltfNodes(GltfDocument& document, const Shutter& shutter, LeftOutList& left_out)
    : document_(document), shutter_(shutter), animation_(document, shutter, left_out) {
    read_parts();
    read_parents();
    apply_animation();
    compose();
    find_shown();
    note_other_scenes(left_out);
}

glm::dmat4 GltfNodes::Parts::to_parent() const {
    if (is_matrix) return matrix;
    glm::dmat4 m(rotation);
    for (int i = 0; i < 3; ++i) m[i] *= scale[i];
    m[3] = glm::dvec4(translation, 1.0);
    return m;
}

glm::dmat3 GltfNodes::Parts::turn() const { return is_matrix ? without_scale(glm::dmat3(matrix)) : rotation; }

void GltfNodes::read_parts() {
    const std::size_t count = document_.count("nodes");
    parts_.resize(count);
    children_.resize(count);
    weights_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const JsonObject node = json(i);
        Parts& parts = parts_[i];
        if (const auto matrix = node.numbers("matrix", 16); !matrix.empty()) {
            parts.matrix = glm::make_mat4(matrix.data());
            parts.is_matrix = true;
        }
        if (const auto t = node.numbers("translation", 3); !t.empty()) parts.translation = glm::make_vec3(t.data());
        if (const auto q = node.numbers("rotation", 4); !q.empty()) parts.rotation = rotation_of(q.data());
        if (const auto s = node.numbers("scale", 3); !s.empty()) parts.scale = glm::make_vec3(s.data());
        if (node.has("weights")) weights_[i] = node.numbers("weights", node.list("weights").size());
        children_[i] = node.indices("children");
    }
}

void GltfNodes::read_parents() {
    parent_.assign(count(), none);
    for (std::size_t i = 0; i < count(); ++i) {
        for (const std::size_t child : children_[i]) {
            json(child);  // throws if there is no such node
            if (child == i) json(i).fail("it is its own ancestor; the file is damaged");
            if (parent_[child] != none) json(child).fail("it has two parents; the file is damaged");
            parent_[child] = i;
        }
    }
}

void GltfNodes::apply_animation() {
    for (std::size_t i = 0; i < count(); ++i) {
        for (const GltfChannel& channel : animation_.channels(i)) {
            if (channel.property != GltfChannel::Property::weights && parts_[i].is_matrix) {
                json(i).fail("it is animated, so it may not have a matrix");
            }
        }
        parts_[i] = parts_at(i, shutter_.opens);
        weights_[i] = weights(i, shutter_.opens);
    }
}

GltfNodes::Parts GltfNodes::parts_at(std::size_t node, double second) const {
    Parts parts = parts_[node];
    for (const GltfChannel& channel : animation_.channels(node)) {
        if (channel.property == GltfChannel::Property::weights) continue;
        const std::vector<double> value = channel.at(second);
        switch (channel.property) {
            case GltfChannel::Property::translation: parts.translation = glm::make_vec3(value.data()); break;
            case GltfChannel::Property::rotation: parts.rotation = rotation_of(value.data()); break;
            case GltfChannel::Property::scale: parts.scale = glm::make_vec3(value.data()); break;
            case GltfChannel::Property::weights: break;
        }
    }
    return parts;
}

std::vector<double> GltfNodes::weights(std::size_t node, double second) const {
    std::vector<double> result = weights_[node];
    for (const GltfChannel& channel : animation_.channels(node)) {
        if (channel.property == GltfChannel::Property::weights) result = channel.at(second);
    }
    return result;
}

GltfNodes::Pose GltfNodes::pose(std::size_t node, double second) const {
    std::vector<std::size_t> line{node};
    while (parent_[line.back()] != none) line.push_back(parent_[line.back()]);
    Pose pose;
    glm::dmat3 turn(1.0);
    for (auto at = line.rbegin(); at != line.rend(); ++at) {
        const Parts parts = parts_at(*at, second);
        pose.to_world = at == line.rbegin() ? parts.to_parent() : pose.to_world * parts.to_parent();
        turn = at == line.rbegin() ? parts.turn() : turn * parts.turn();
    }
    pose.forward = forward_under(pose.to_world, turn);
    return pose;
}

std::uint32_t GltfNodes::least_parts(std::size_t node) const {
    std::uint32_t most = 0;
    for (std::size_t at = node; at != none; at = parent_[at]) most = std::max(most, animation_.least_parts(at));
    return most;
}

void GltfNodes::compose() {
    to_world_.resize(count());
    forward_.resize(count());
    std::vector<glm::dmat3> turns(count());
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < count(); ++i) {
        if (parent_[i] == none) order.push_back(i);
    }
    for (std::size_t at = 0; at < order.size(); ++at) {
        const std::size_t i = order[at];
        const bool is_root = parent_[i] == none;
        to_world_[i] = is_root ? parts_[i].to_parent() : to_world_[parent_[i]] * parts_[i].to_parent();
        turns[i] = is_root ? parts_[i].turn() : turns[parent_[i]] * parts_[i].turn();
        forward_[i] = forward_under(to_world_[i], turns[i]);
        order.insert(order.end(), children_[i].begin(), children_[i].end());
    }
    if (order.size() == count()) return;
    // A node that no root reaches is in a cycle, or below one.
    std::vector<bool> reached(count());
    for (const std::size_t i : order) reached[i] = true;
    const auto lost = std::find(reached.begin(), reached.end(), false) - reached.begin();
    json(static_cast<std::size_t>(lost)).fail("it is its own ancestor; the file is damaged");
}

/// The default scene's root nodes; of a file without scenes, the nodes without a parent.
std::vector<std::size_t> GltfNodes::roots() const {
    if (document_.count("scenes") > 0) {
        const JsonObject scene = document_.element("scenes", document_.root().whole_number("scene", 0), "scene");
        std::vector<std::size_t> roots = scene.indices("nodes");
        for (const std::size_t root : roots) {
            json(root);
            if (parent_[root] != none) scene.fail("node " + std::to_string(root) + " is no root; correct `nodes`");
        }
        return roots;
    }
    std::vector<std::size_t> roots;
    for (std::size_t i = 0; i < count(); ++i) {
        if (parent_[i] == none) roots.push_back(i);
    }
    return roots;
}

/// Notes the scenes other than the default one, and the nodes that belong to no scene.
void GltfNodes::note_other_scenes(LeftOutList& left_out) const {
    const std::size_t scenes = document_.count("scenes");
    if (scenes == 0) return;
    const std::size_t shown = document_.root().whole_number("scene", 0);
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < scenes; ++i) {
        const JsonObject scene = document_.element("scenes", i, "scene");
        if (i != shown) leave_out(left_out, scene.name(), "the file's default scene is shown");
        const nlohmann::json& nodes = scene.list("nodes");
        for (const nlohmann::json& node : nodes) {
            if (node.is_number_unsigned() && node.get<std::size_t>() < count()) open.push_back(node.get<std::size_t>());
        }
    }
    std::vector<bool> reached(count());
    while (!open.empty()) {
        const std::size_t i = open.back();
        open.pop_back();
        if (reached[i]) continue;
        reached[i] = true;
        open.insert(open.end(), children_[i].begin(), children_[i].end());
    }
    for (std::size_t i = 0; i < count(); ++i) {
        const JsonObject node = json(i);
        const bool is_seen = node.has("mesh") || node.has("camera") || node.extension("KHR_lights_punctual");
        if (!reached[i] && is_seen) leave_out(left_out, node.name(), "it is in no scene");
    }
}

void GltfNodes::find_shown() {
    std::vector<std::size_t> open = roots();
    std::reverse(open.begin(), open.end());
    std::vector<bool> seen(count());
    while (!open.empty()) {
        const std::size_t i = open.back();
        open.pop_back();
        if (seen[i]) continue;  // a root that the scene names twice
        seen[i] = true;
        const auto visibility = json(i).extension("KHR_node_visibility");
        if (visibility && !visibility->flag("visible", true)) continue;
        shown_.push_back(i);
        open.insert(open.end(), children_[i].rbegin(), children_[i].rend());
    }
}

}  // namespace render
