#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace render {

/// Makes a glTF file in memory, part by part: callers write into its JSON, and numbers go into one buffer.
class GltfWriter {
public:
    using Json = nlohmann::json;

    /// One scene, which shows nothing yet.
    Json json = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", Json::array({{{"nodes", Json::array()}}})}};

    /// Appends to a list of the file; returns the index.
    std::size_t append(const char* list, const Json& element);

    /// Adds an accessor of `values`, `components` each; returns its index.
    template <class T>
    std::size_t add(const std::vector<T>& values, const char* type, std::size_t components, bool normalized = false) {
        Json accessor = {{"bufferView", add_view(values)},
                         {"componentType", component_type(T{})},
                         {"count", values.size() / components},
                         {"type", type}};
        if (normalized) accessor["normalized"] = true;
        return append("accessors", accessor);
    }

    template <class T>
    std::size_t add_view(const std::vector<T>& values) {
        std::string bytes(values.size() * sizeof(T), '\0');
        if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
        return add_bytes(bytes);
    }

    /// A bufferView with these bytes.
    std::size_t add_bytes(const std::string& bytes);

    /// A node that the scene shows.
    std::size_t add_node(const Json& node);

    /// A mesh of one primitive: two triangles of four vertices, unless `members` has other indices.
    std::size_t add_mesh(const Json& attributes, Json members = Json::object());

    /// A material that reflects diffusely, as far as the format has such, with `members`; `pbr`: of its
    /// pbrMetallicRoughness.
    std::size_t add_material(const Json& members = Json::object(), const Json& pbr = Json::object());

    /// A file beside the scene, by its name.
    void add_file(const std::string& name, const std::string& bytes) { files_[folder + name] = bytes; }

    /// The scene's text, which refers to the buffer.
    std::string text() const;

    /// All files by their paths: `path` is the scene's.
    std::map<std::string, std::string> files() const;

    static constexpr const char* folder = "scene/";
    static constexpr const char* path = "scene/scene.gltf";

private:
    static int component_type(std::int8_t) { return 5120; }
    static int component_type(std::uint8_t) { return 5121; }
    static int component_type(std::int16_t) { return 5122; }
    static int component_type(std::uint16_t) { return 5123; }
    static int component_type(std::uint32_t) { return 5125; }
    static int component_type(float) { return 5126; }

    std::string data_;
    std::map<std::string, std::string> files_;
};

}  // namespace render
