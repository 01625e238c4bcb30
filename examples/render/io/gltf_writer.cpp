#include "io/gltf_writer.hpp"

namespace render {

std::size_t GltfWriter::append(const char* list, const Json& element) {
    json[list].push_back(element);
    return json[list].size() - 1;
}

std::size_t GltfWriter::add_bytes(const std::string& bytes) {
    data_.resize((data_.size() + 3) / 4 * 4);
    const std::size_t offset = data_.size();
    data_ += bytes;
    return append("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
}

std::size_t GltfWriter::add_node(const Json& node) {
    const std::size_t index = append("nodes", node);
    json["scenes"][0]["nodes"].push_back(index);
    return index;
}

std::size_t GltfWriter::add_mesh(const Json& attributes, Json members) {
    members["attributes"] = attributes;
    if (!members.contains("indices"))
        members["indices"] = add(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR", 1);
    return append("meshes", {{"primitives", Json::array({members})}});
}

std::size_t GltfWriter::add_material(const Json& members, const Json& pbr) {
    Json material = members;
    material["pbrMetallicRoughness"] = {{"metallicFactor", 0}, {"roughnessFactor", 1}};
    material["pbrMetallicRoughness"].update(pbr);
    return append("materials", material);
}

std::string GltfWriter::text() const {
    Json whole = json;
    if (!data_.empty()) whole["buffers"] = Json::array({{{"byteLength", data_.size()}, {"uri", "data.bin"}}});
    return whole.dump();
}

std::map<std::string, std::string> GltfWriter::files() const {
    std::map<std::string, std::string> all = files_;
    all[std::string(folder) + "data.bin"] = data_;
    all[path] = text();
    return all;
}

}  // namespace render
