#include "io/gltf_mesh.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <lightcuts/core/invalid_input.hpp>

#include "io/gltf_accessor.hpp"

namespace render {
namespace {

enum class Mode : std::size_t { list = 4, strip = 5, fan = 6 };

std::vector<glm::dvec3> vectors_of(const std::vector<double>& numbers) {
    std::vector<glm::dvec3> result;
    result.reserve(numbers.size() / 3);
    for (std::size_t i = 0; i + 2 < numbers.size(); i += 3) {
        result.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
    }
    return result;
}

std::string numbered(const char* name, std::size_t number) { return name + std::to_string(number); }

}  // namespace

const GltfMesh& GltfMeshes::mesh(std::size_t index) {
    const auto known = meshes_.find(index);
    return known != meshes_.end() ? known->second : meshes_.emplace(index, read(index)).first->second;
}

GltfMesh GltfMeshes::read(std::size_t index) {
    GltfMesh mesh;
    const JsonObject source = document_.element("meshes", index, "mesh");
    if (source.has("weights")) mesh.weights = source.numbers("weights", source.list("weights").size());
    const nlohmann::json& primitives = source.list("primitives");
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        const JsonObject part(primitives[i], source.name() + " primitive " + std::to_string(i));
        const std::size_t mode = part.whole_number("mode", static_cast<std::size_t>(Mode::list));
        if (mode > static_cast<std::size_t>(Mode::fan)) part.refuse("mode", "one that the format knows");
        if (mode < static_cast<std::size_t>(Mode::list)) {
            leave_out(scene_.left_out, "points and lines", "they have no surface");
            continue;
        }
        GltfPrimitive primitive;
        primitive.name = part.name();
        read_primitive(part, primitive);
        if (!primitive.positions.empty()) mesh.primitives.push_back(std::move(primitive));
    }
    return mesh;
}

/// Of an attribute that is there, as many elements as there are vertices.
std::vector<double> GltfMeshes::attribute(const JsonObject& attributes, const char* name, std::size_t components,
                                          std::size_t count) const {
    const auto accessor = attributes.index(name);
    if (!accessor) return {};
    std::vector<double> values;
    try {
        constexpr std::size_t all = std::numeric_limits<std::size_t>::max();
        values = read_accessor(document_, *accessor, components, all, "vertex");
    } catch (const lightcuts::invalid_input& problem) { attributes.fail(std::string(name) + ": " + problem.what()); }
    if (values.size() != count * components) {
        attributes.fail("its attributes differ in length; the file is damaged");
    }
    return values;
}

std::vector<glm::dvec4> GltfMeshes::colors(const JsonObject& attributes, std::size_t count, double alpha) const {
    const auto accessor = attributes.index("COLOR_0");
    if (!accessor) return {};
    const std::size_t components = components_of(document_, *accessor);
    if (components != 3 && components != 4) attributes.fail("COLOR_0 has not three or four components");
    const std::vector<double> v = attribute(attributes, "COLOR_0", components, count);
    std::vector<glm::dvec4> result;
    result.reserve(count);
    for (std::size_t i = 0; i < v.size(); i += components) {
        result.emplace_back(v[i], v[i + 1], v[i + 2], components == 4 ? v[i + 3] : alpha);
    }
    return result;
}

void GltfMeshes::read_primitive(const JsonObject& source, GltfPrimitive& primitive) {
    const JsonObject attributes(source.object("attributes"));
    const auto positions = attributes.index("POSITION");
    if (!positions) return;
    if (source.extension("KHR_draco_mesh_compression") && !has_data(document_, *positions)) {
        source.fail("it is compressed by KHR_draco_mesh_compression alone, which is not supported; export without");
    }
    const std::size_t count = document_.element("accessors", *positions, "accessor").needed("count");
    if (!has_data(document_, *positions) && source.list("targets").empty()) return;  // all in one point
    primitive.positions = vectors_of(attribute(attributes, "POSITION", 3, count));
    primitive.normals = vectors_of(attribute(attributes, "NORMAL", 3, count));
    primitive.material = materials_.in_scene(source.index("material"));
    if (scene_.materials[primitive.material].normal_texture.is_there()) {
        const std::vector<double> t = attribute(attributes, "TANGENT", 4, count);
        for (std::size_t i = 0; i < t.size(); i += 4)
            primitive.tangents.emplace_back(t[i], t[i + 1], t[i + 2], t[i + 3]);
    }
    primitive.colors = colors(attributes, count, 1.0);
    read_uvs(attributes, primitive);
    read_bones(attributes, primitive);
    read_morphs(source, primitive);
    read_triangles(source, primitive);
}

void GltfMeshes::read_uvs(const JsonObject& attributes, GltfPrimitive& primitive) {
    const Material& material = scene_.materials[primitive.material];
    for (const TextureUse* use : textures_of(material)) {
        if (!use->is_there()) continue;
        const std::size_t number = materials_.uv_sets()[use->uv_set];
        if (primitive.uvs.contains(number)) continue;
        const std::string name = numbered("TEXCOORD_", number);
        if (!attributes.has(name.c_str())) {
            leave_out(scene_.left_out, "where on " + primitive.name + " its textures lie", "it has no " + name);
            continue;
        }
        const std::vector<double> v = attribute(attributes, name.c_str(), 2, primitive.positions.size());
        std::vector<glm::vec2>& uvs = primitive.uvs[number];
        uvs.reserve(primitive.positions.size());
        for (std::size_t i = 0; i < v.size(); i += 2) uvs.emplace_back(glm::dvec2(v[i], v[i + 1]));
    }
}

/// What is wrong with them matters to those alone who have a skin.
void GltfMeshes::read_bones(const JsonObject& attributes, GltfPrimitive& primitive) {
    try {
        for (std::size_t set = 0; attributes.has(numbered("JOINTS_", set).c_str()); ++set) {
            read_bones(attributes, set, primitive);
        }
    } catch (const lightcuts::invalid_input& problem) { primitive.bones_problem = problem.what(); }
}

void GltfMeshes::read_bones(const JsonObject& attributes, std::size_t set, GltfPrimitive& primitive) {
    const std::size_t count = primitive.positions.size();
    const std::vector<double> joints = attribute(attributes, numbered("JOINTS_", set).c_str(), 4, count);
    const std::vector<double> weights = attribute(attributes, numbered("WEIGHTS_", set).c_str(), 4, count);
    if (weights.empty()) attributes.fail("it has joints without weights; the file is damaged");
    std::vector<GltfBones>& bones = primitive.bones.emplace_back(count);
    for (std::size_t v = 0; v < count; ++v) {
        std::copy_n(&joints[4 * v], 4, bones[v].joints.begin());
        std::copy_n(&weights[4 * v], 4, bones[v].weights.begin());
    }
}

void GltfMeshes::read_morphs(const JsonObject& source, GltfPrimitive& primitive) {
    const std::size_t count = primitive.positions.size();
    const nlohmann::json& targets = source.list("targets");
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const JsonObject target(targets[i], source.name() + " target " + std::to_string(i));
        GltfMorph& morph = primitive.morphs.emplace_back();
        morph.positions = vectors_of(attribute(target, "POSITION", 3, count));
        morph.normals = vectors_of(attribute(target, "NORMAL", 3, count));
        morph.tangents = vectors_of(attribute(target, "TANGENT", 3, count));
        morph.colors = colors(target, count, 0.0);
        if (target.has("TEXCOORD_0")) leave_out(scene_.left_out, "morphing of uvs", "not supported");
    }
}

void GltfMeshes::read_triangles(const JsonObject& source, GltfPrimitive& primitive) {
    const std::size_t count = primitive.positions.size();
    if (count > std::numeric_limits<std::uint32_t>::max() / 2) source.fail("it has too many vertices; split it");
    std::vector<std::uint32_t> corners;
    if (const auto accessor = source.index("indices")) {
        std::vector<double> indices;
        try {
            indices = read_accessor(document_, *accessor, 1);
        } catch (const lightcuts::invalid_input& problem) { source.fail(std::string("indices: ") + problem.what()); }
        corners.reserve(indices.size());
        for (const double v : indices) {
            if (!(v >= 0.0 && v < static_cast<double>(count))) {
                source.fail("an index is past its " + std::to_string(count) + " vertices; the file is damaged");
            }
            corners.push_back(static_cast<std::uint32_t>(v));
        }
    } else {
        for (std::size_t i = 0; i < count; ++i) corners.push_back(static_cast<std::uint32_t>(i));
    }
    const auto mode = static_cast<Mode>(source.whole_number("mode", static_cast<std::size_t>(Mode::list)));
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        primitive.triangles.emplace_back(corners[a], corners[b], corners[c]);
    };
    for (std::size_t i = 0; i + 2 < corners.size(); i += mode == Mode::list ? 3 : 1) {
        switch (mode) {
            case Mode::list: add(i, i + 1, i + 2); break;
            case Mode::strip: i % 2 == 0 ? add(i, i + 1, i + 2) : add(i + 1, i, i + 2); break;
            case Mode::fan: add(0, i + 1, i + 2); break;
        }
    }
}

}  // namespace render
