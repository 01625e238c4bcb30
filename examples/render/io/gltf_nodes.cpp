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

#include "io/escape.hpp"
#include "io/gltf_accessor.hpp"

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

}  // namespace

glm::dmat3 rotation_of(const double* q) {
    const glm::dquat quaternion(q[3], q[0], q[1], q[2]);
    return glm::length(quaternion) > 0.0 ? glm::mat3_cast(glm::normalize(quaternion)) : glm::dmat3(1.0);
}

GltfNodes::GltfNodes(GltfDocument& document, LeftOutList& left_out) : document_(document) {
    read_parts();
    read_parents();
    apply_animation(left_out);
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

void GltfNodes::apply_animation(LeftOutList& left_out) {
    const std::size_t animations = document_.count("animations");
    if (animations == 0) return;
    const JsonObject first = document_.element("animations", 0, "animation");
    for (const nlohmann::json& json : first.list("channels")) {
        apply_channel(first, JsonObject(json, first.name() + ": a channel"), left_out);
    }
    leave_out(left_out, animations > 1 ? "all animations but the first" : "the animation",
              animations > 1 ? "a picture shows one moment, the beginning of the first"
                             : "a picture shows one moment, its beginning");
}

/// Takes the first key's value, which holds before it, too.
void GltfNodes::apply_channel(const JsonObject& animation, const JsonObject& channel, LeftOutList& left_out) {
    const JsonObject target = channel.object("target");
    const auto node = target.index("node");
    if (!node) return;  // the target of an extension
    json(*node);
    const std::string path = target.text("path");
    if (path != "translation" && path != "rotation" && path != "scale" && path != "weights") {
        leave_out(left_out, "an animation of '" + excerpt(path) + "'", "such channels are unknown");
        return;
    }
    const std::size_t sampler_index = channel.needed("sampler");
    const nlohmann::json& samplers = animation.list("samplers");
    if (sampler_index >= samplers.size()) channel.fail("its sampler does not exist; the file is damaged");
    const JsonObject sampler(samplers[sampler_index], animation.name() + ": a sampler");
    const std::size_t output = sampler.needed("output");
    const std::size_t components = components_of(document_, output);
    // A cubic spline's keys are triples: incoming tangent, value, outgoing tangent.
    const bool is_cubic = sampler.text("interpolation", "LINEAR") == "CUBICSPLINE";
    const auto count_of = [&](std::size_t accessor) {
        return document_.element("accessors", accessor, "accessor").needed("count");
    };
    const std::size_t keys = count_of(sampler.needed("input")) * (is_cubic ? 3 : 1);
    // A key of weights has one element for each weight; a key of anything else is one element.
    const std::size_t elements = keys > 0 ? count_of(output) / keys : 0;
    const bool fits = path == "weights" ? components == 1 && elements > 0
                                        : components == (path == "rotation" ? 4u : 3u) && elements == 1;
    if (!fits) sampler.fail("its output has not one " + path + " for each key; correct it");
    const std::vector<double> values = read_accessor(document_, output, components, (is_cubic ? 2 : 1) * elements);
    const std::vector<double> value(values.end() - static_cast<std::ptrdiff_t>(elements * components), values.end());
    Parts& parts = parts_[*node];
    if (path == "weights") {
        weights_[*node] = value;
    } else if (path == "translation") {
        parts.translation = glm::make_vec3(value.data());
    } else if (path == "rotation") {
        parts.rotation = rotation_of(value.data());
    } else {
        parts.scale = glm::make_vec3(value.data());
    }
    if (path != "weights" && parts.is_matrix) json(*node).fail("it is animated, so it may not have a matrix");
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
        // The image of -z under the whole transform; where a scale of zero makes that the null vector, under the
        // rotations alone.
        const glm::dvec3 axis = -glm::dvec3(to_world_[i][2]);
        const double length = glm::length(axis);
        const double rest = glm::length(turns[i][2]);
        forward_[i] = length > 0.0 ? axis / length : rest > 0.0 ? -turns[i][2] / rest : glm::dvec3(0.0);
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
