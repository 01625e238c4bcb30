#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <render/io/file_source.hpp>
#include <render/io/load_gltf.hpp>
#include <render/load_scene.hpp>
#include <render/scene.hpp>
#include <render/validate.hpp>

/// Makes glTF files in memory, part by part.
class GltfBuilder {
public:
    using Json = nlohmann::json;

    Json json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", Json::array({{{"nodes", Json::array()}}})}};

    /// Adds an accessor of `values`, `components` each; returns its index.
    template <class T>
    std::size_t add(const std::vector<T>& values, const char* type, std::size_t components, bool normalized = false) {
        const std::size_t view = add_view(values);
        Json accessor = {{"bufferView", view},
                         {"componentType", component_type(T{})},
                         {"count", values.size() / components},
                         {"type", type}};
        if (normalized) accessor["normalized"] = true;
        return append("accessors", accessor);
    }

    template <class T>
    std::size_t add_view(const std::vector<T>& values) {
        data_.resize((data_.size() + 3) / 4 * 4);
        const std::size_t offset = data_.size();
        data_.resize(offset + values.size() * sizeof(T));
        std::memcpy(data_.data() + offset, values.data(), values.size() * sizeof(T));
        return append("bufferViews",
                      {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", values.size() * sizeof(T)}});
    }

    /// Appends to a list of the file; returns the index.
    std::size_t append(const char* list, const Json& element) {
        json[list].push_back(element);
        return json[list].size() - 1;
    }

    /// A node that the scene shows.
    std::size_t add_node(const Json& node) {
        const std::size_t index = append("nodes", node);
        json["scenes"][0]["nodes"].push_back(index);
        return index;
    }

    /// The attributes of a square on the plane y = 0, x from `left` to `left` + 1, z from -1 to 1, seen from above.
    Json square(float left = -1.0f) {
        const float right = left + 1.0f;
        return {{"POSITION", add<float>({left, 0, 1, right, 0, 1, right, 0, -1, left, 0, -1}, "VEC3", 3)}};
    }

    /// A mesh of one primitive with those attributes and members besides.
    std::size_t add_mesh(const Json& attributes, Json members = Json::object()) {
        if (indices_ == none) indices_ = add<std::uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR", 1);
        members["attributes"] = attributes;
        if (!members.contains("indices")) members["indices"] = indices_;
        return append("meshes", {{"primitives", Json::array({members})}});
    }

    /// One that reflects `color` diffusely, and members besides.
    std::size_t add_material(const Json& members = Json::object(), const Json& pbr = Json::object()) {
        Json material = members;
        material["pbrMetallicRoughness"] = {{"metallicFactor", 0}, {"roughnessFactor", 1}};
        material["pbrMetallicRoughness"].update(pbr);
        return append("materials", material);
    }

    /// A file beside the scene.
    void add_file(const std::string& name, const std::string& bytes) { files_["scene/" + name] = bytes; }

    std::string text() const {
        Json whole = json;
        if (!data_.empty()) whole["buffers"] = Json::array({{{"byteLength", data_.size()}, {"uri", "data.bin"}}});
        return whole.dump();
    }

    std::map<std::string, std::string> files() const {
        std::map<std::string, std::string> all = files_;
        all["scene/data.bin"] = data_;
        all["scene/scene.gltf"] = text();
        return all;
    }

    /// Read and checked.
    render::Scene load() const {
        render::Scene scene = render::load_gltf("scene/scene.gltf", render::MemoryFiles(files()));
        render::validate(scene);
        return scene;
    }

private:
    static int component_type(std::int8_t) { return 5120; }
    static int component_type(std::uint8_t) { return 5121; }
    static int component_type(std::int16_t) { return 5122; }
    static int component_type(std::uint16_t) { return 5123; }
    static int component_type(std::uint32_t) { return 5125; }
    static int component_type(float) { return 5126; }

    static constexpr std::size_t none = ~std::size_t{0};

    std::string data_;
    std::size_t indices_ = none;
    std::map<std::string, std::string> files_;
};
