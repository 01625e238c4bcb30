#include "io/gltf_pose.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <lightcuts/core/invalid_input.hpp>

#include "io/gltf_accessor.hpp"

namespace render {
namespace {

/// Joints are indices of 16 bits.
constexpr double most_joints = 65535.0;

template <class V>
void add(std::vector<V>& to, const std::vector<V>& difference, double weight) {
    for (std::size_t i = 0; i < std::min(to.size(), difference.size()); ++i) to[i] += weight * difference[i];
}

}  // namespace

GltfPrimitive morphed(const GltfPrimitive& primitive, const std::vector<double>& weights) {
    GltfPrimitive result = primitive;
    for (std::size_t t = 0; t < std::min(weights.size(), primitive.morphs.size()); ++t) {
        const GltfMorph& morph = primitive.morphs[t];
        if (weights[t] == 0.0) continue;
        add(result.positions, morph.positions, weights[t]);
        add(result.normals, morph.normals, weights[t]);
        add(result.colors, morph.colors, weights[t]);
        for (std::size_t i = 0; i < std::min(result.tangents.size(), morph.tangents.size()); ++i) {
            result.tangents[i] += glm::dvec4(weights[t] * morph.tangents[i], 0.0);
        }
    }
    for (glm::dvec4& color : result.colors) color = glm::clamp(color, 0.0, 1.0);
    return result;
}

const std::vector<glm::dmat4>& GltfSkins::joints(std::size_t index) {
    const auto known = joints_.find(index);
    if (known != joints_.end()) return known->second;
    const JsonObject skin = document_.element("skins", index, "skin");
    std::vector<glm::dmat4> matrices;
    for (const std::size_t joint : skin.indices("joints")) {
        nodes_.json(joint);  // throws if there is none
        matrices.push_back(nodes_.to_world(joint));
    }
    if (const auto accessor = skin.index("inverseBindMatrices")) {
        const std::vector<double> inverse = read_accessor(document_, *accessor, 16);
        if (inverse.size() < 16 * matrices.size()) skin.fail("it has fewer inverseBindMatrices than joints");
        for (std::size_t j = 0; j < matrices.size(); ++j) {
            matrices[j] = matrices[j] * glm::make_mat4(&inverse[16 * j]);
        }
    }
    return joints_.emplace(index, std::move(matrices)).first->second;
}

std::vector<glm::dmat4> GltfSkins::to_world(std::size_t index, const GltfPrimitive& primitive) {
    if (!primitive.bones_problem.empty()) throw lightcuts::invalid_input(primitive.bones_problem);
    const std::vector<glm::dmat4>& matrices = joints(index);
    std::vector<bool> is_used(primitive.positions.size());
    for (const glm::uvec3& t : primitive.triangles) is_used[t.x] = is_used[t.y] = is_used[t.z] = true;
    // Where vertices of no triangle go is of no matter, as long as they stay near the others.
    std::vector<glm::dmat4> result(primitive.positions.size(), matrices.empty() ? glm::dmat4(1.0) : matrices.front());
    for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
        if (is_used[v]) result[v] = blend(index, primitive, v, matrices);
    }
    return result;
}

glm::dmat4 GltfSkins::blend(std::size_t index, const GltfPrimitive& primitive, std::size_t vertex,
                            const std::vector<glm::dmat4>& matrices) const {
    const auto fail = [&](const std::string& problem) {
        document_.element("skins", index, "skin").fail(primitive.name + " has " + problem);
    };
    glm::dmat4 sum(0.0);
    double weights = 0.0;
    for (const std::vector<GltfBones>& set : primitive.bones) {
        for (std::size_t k = 0; k < 4; ++k) {
            const double weight = set[vertex].weights[k];
            if (weight == 0.0) continue;
            if (weight < 0.0) fail("a vertex with a negative weight; the file is damaged");
            const double joint = set[vertex].joints[k];
            if (!(joint >= 0.0 && joint <= most_joints)) fail("a vertex of which a joint is no index");
            if (joint >= static_cast<double>(matrices.size())) {
                fail("a vertex of joint " + std::to_string(std::lround(joint)) + ", which does not exist");
            }
            sum += weight * matrices[static_cast<std::size_t>(joint)];
            weights += weight;
        }
    }
    if (!(weights > 0.0)) fail("a vertex that no joint moves");
    return sum / weights;
}

std::vector<glm::dmat4> instances_of(GltfDocument& document, const JsonObject& node) {
    const auto extension = node.extension("EXT_mesh_gpu_instancing");
    if (!extension) return {glm::dmat4(1.0)};
    const JsonObject attributes = extension->object("attributes");
    const auto read = [&](const char* name, std::size_t components) {
        const auto accessor = attributes.index(name);
        if (!accessor) return std::vector<double>();
        if (!has_data(document, *accessor)) attributes.fail(std::string(name) + " holds no data; export it again");
        try {
            return read_accessor(document, *accessor, components);
        } catch (const lightcuts::invalid_input& problem) {
            attributes.fail(std::string(name) + ": " + problem.what());
        }
    };
    const std::vector<double> translations = read("TRANSLATION", 3);
    const std::vector<double> rotations = read("ROTATION", 4);
    const std::vector<double> scales = read("SCALE", 3);
    const std::size_t count = std::max({translations.size() / 3, rotations.size() / 4, scales.size() / 3});
    const auto fits = [&](const std::vector<double>& v, std::size_t n) { return v.empty() || v.size() == n * count; };
    if (!fits(translations, 3) || !fits(rotations, 4) || !fits(scales, 3)) {
        attributes.fail("the attributes differ in length; the file is damaged");
    }
    std::vector<glm::dmat4> result(count, glm::dmat4(1.0));
    for (std::size_t i = 0; i < count; ++i) {
        glm::dmat4& m = result[i];
        if (!translations.empty()) m = glm::translate(m, glm::make_vec3(&translations[3 * i]));
        if (!rotations.empty()) { m = m * glm::dmat4(rotation_of(&rotations[4 * i])); }
        if (!scales.empty()) m = glm::scale(m, glm::make_vec3(&scales[3 * i]));
    }
    return result;
}

}  // namespace render
