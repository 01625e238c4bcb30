#include "io/gltf_pose.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
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

glm::vec4 posed_tangent(const glm::dmat3& linear, const glm::dvec4& v) {
    const double side = glm::determinant(linear) < 0.0 ? -v.w : v.w;
    return {unit_or_zero(linear * glm::dvec3(v)), side < 0.0 ? -1.0f : 1.0f};
}

}  // namespace

glm::vec3 unit_or_zero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return glm::vec3(length > 0.0 ? v / length : v);
}

PosedVertices posed_vertices(const GltfPrimitive& primitive, std::span<const glm::dmat4> to_world) {
    PosedVertices posed;
    const glm::dmat4* transform = nullptr;
    glm::dmat3 linear(1.0);
    glm::dmat3 normal_matrix(1.0);
    for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
        if (const glm::dmat4* own = &to_world[to_world.size() > 1 ? v : 0]; own != transform) {
            transform = own;
            linear = glm::dmat3(*transform);
            const bool invertible = glm::determinant(linear) != 0.0;
            normal_matrix = invertible ? glm::transpose(glm::inverse(linear)) : glm::dmat3(1.0);
        }
        posed.positions.emplace_back(*transform * glm::dvec4(primitive.positions[v], 1.0));
        posed.normals.push_back(primitive.normals.empty() ? glm::vec3(0.0f)
                                                          : unit_or_zero(normal_matrix * primitive.normals[v]));
        posed.tangents.push_back(primitive.tangents.empty() ? glm::vec4(0.0f)
                                                            : posed_tangent(linear, primitive.tangents[v]));
    }
    return posed;
}

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

const GltfSkins::Skin& GltfSkins::skin(std::size_t index) {
    const auto known = skins_.find(index);
    if (known != skins_.end()) return known->second;
    const JsonObject json = document_.element("skins", index, "skin");
    Skin skin;
    for (const std::size_t joint : json.indices("joints")) {
        nodes_.json(joint);  // throws if there is none
        skin.joints.push_back(joint);
        skin.to_world.push_back(nodes_.to_world(joint));
    }
    if (const auto accessor = json.index("inverseBindMatrices")) {
        const std::vector<double> inverse = read_accessor(document_, *accessor, 16);
        if (inverse.size() < 16 * skin.joints.size()) json.fail("it has fewer inverseBindMatrices than joints");
        for (std::size_t j = 0; j < skin.joints.size(); ++j) {
            skin.inverse.push_back(glm::make_mat4(&inverse[16 * j]));
            skin.to_world[j] = skin.to_world[j] * skin.inverse[j];
        }
    }
    return skins_.emplace(index, std::move(skin)).first->second;
}

std::vector<glm::dmat4> GltfSkins::to_world(std::size_t index, const GltfPrimitive& primitive) {
    if (!primitive.bones_problem.empty()) throw lightcuts::invalid_input(primitive.bones_problem);
    return blended(index, primitive, skin(index).to_world);
}

std::vector<glm::dmat4> GltfSkins::to_world(std::size_t index, const GltfPrimitive& primitive, double second) const {
    const Skin& skin = skins_.at(index);
    std::vector<glm::dmat4> matrices;
    for (std::size_t j = 0; j < skin.joints.size(); ++j) {
        const glm::dmat4 joint = nodes_.pose(skin.joints[j], second).to_world;
        matrices.push_back(skin.inverse.empty() ? joint : joint * skin.inverse[j]);
    }
    return blended(index, primitive, matrices);
}

std::uint32_t GltfSkins::least_parts(std::size_t index) const {
    std::uint32_t most = 0;
    for (const std::size_t joint : skins_.at(index).joints) most = std::max(most, nodes_.least_parts(joint));
    return most;
}

std::vector<glm::dmat4> GltfSkins::blended(std::size_t index, const GltfPrimitive& primitive,
                                           const std::vector<glm::dmat4>& matrices) const {
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
