#include "io/gltf_document.hpp"

#include <algorithm>
#include <cstring>
#include <set>
#include <utility>

#include <lightcuts/core/invalid_input.hpp>

#include "io/escape.hpp"
#include "io/text_file.hpp"
#include "io/uri.hpp"

namespace render {
namespace {

using lightcuts::invalid_input;
using Json = nlohmann::json;

constexpr std::array<std::string_view, 13> supported_extensions{"EXT_mesh_gpu_instancing",
                                                                "KHR_lights_punctual",
                                                                "KHR_materials_diffuse_transmission",
                                                                "KHR_materials_emissive_strength",
                                                                "KHR_materials_ior",
                                                                "KHR_materials_pbrSpecularGlossiness",
                                                                "KHR_materials_specular",
                                                                "KHR_materials_transmission",
                                                                "KHR_materials_unlit",
                                                                "KHR_mesh_quantization",
                                                                "KHR_node_visibility",
                                                                "KHR_texture_transform",
                                                                "KHR_xmp_json_ld"};  // does not affect the picture

/// Bytes of a path that a system takes.
constexpr std::size_t longest_name = 4096;

/// What a picture shows instead.
struct Substitute {
    std::string_view extension;
    const char* what;
    bool may_be_required;
};
constexpr std::array substitutes{
    Substitute{"KHR_materials_volume", "what light passes is thin: it neither bends nor absorbs light", true},
    Substitute{"KHR_materials_variants", "the default materials are used", true},
    Substitute{"KHR_texture_basisu", "the image beside it is used, if there is one", false},
    Substitute{"EXT_texture_webp", "the image beside it is used, if there is one", false},
    Substitute{"EXT_texture_avif", "the image beside it is used, if there is one", false},
    Substitute{"MSFT_texture_dds", "the image beside it is used, if there is one", false},
    Substitute{"KHR_draco_mesh_compression", "the uncompressed data beside it is used", false},
    Substitute{"EXT_meshopt_compression", "the uncompressed data beside it is used", false},
};

bool is_supported(std::string_view name) {
    return std::find(supported_extensions.begin(), supported_extensions.end(), name) != supported_extensions.end();
}

const Substitute* substitute_for(std::string_view name) {
    const auto found = std::find_if(substitutes.begin(), substitutes.end(),
                                    [&](const Substitute& s) { return s.extension == name; });
    return found == substitutes.end() ? nullptr : &*found;
}

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
    const auto byte = [&](std::size_t i) {
        return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i]));
    };
    return byte(0) | byte(1) << 8 | byte(2) << 16 | byte(3) << 24;
}

/// Names of all members of all objects `extensions`, without what people put into `extras`.
std::set<std::string> extensions_in(const Json& json) {
    std::set<std::string> names;
    std::vector<const Json*> open{&json};
    while (!open.empty()) {
        const Json& at = *open.back();
        open.pop_back();
        if (at.is_array()) {
            for (const Json& each : at) {
                if (each.is_structured()) open.push_back(&each);
            }
            continue;
        }
        for (auto member = at.begin(); member != at.end(); ++member) {
            if (!member->is_structured() || member.key() == "extras") continue;
            if (member.key() == "extensions" && member->is_object()) {
                for (auto extension = member->begin(); extension != member->end(); ++extension) {
                    names.insert(extension.key());
                }
            }
            open.push_back(&*member);
        }
    }
    return names;
}

}  // namespace

GltfDocument::GltfDocument(const std::filesystem::path& path, const FileSource& files)
    : files_(files), folder_(path.parent_path()) {
    parse(files.read(path));
    require_version();
    require_extensions();
    buffers_.resize(count("buffers"));
}

void GltfDocument::parse(std::string bytes) {
    parse_json(bytes.starts_with("glTF") ? split_binary(bytes) : std::string_view(bytes));
    if (!json_.is_object()) throw invalid_input("not a glTF file; its JSON is no object");
}

/// The JSON of a .glb; keeps its binary chunk.
std::string_view GltfDocument::split_binary(std::string_view bytes) {
    constexpr std::size_t header = 12;
    constexpr std::uint32_t json_chunk = 0x4E4F534A;
    constexpr std::uint32_t binary_chunk = 0x004E4942;
    const auto fail = [](const std::string& problem) {
        throw invalid_input("not a whole glTF file (" + problem + ")");
    };
    if (bytes.size() < header + 8) fail("it ends within its header");
    const std::uint32_t version = word_at(bytes, 4);
    if (version != 2) throw invalid_input("is glTF " + std::to_string(version) + ".0; convert it to glTF 2.0");
    const std::uint32_t size = word_at(bytes, 8);
    if (size > bytes.size()) {
        fail("it has " + std::to_string(bytes.size()) + " of its " + std::to_string(size) + " bytes");
    }
    std::string_view json;
    for (std::size_t at = header; at + 8 <= size;) {
        const std::size_t length = word_at(bytes, at);
        const std::uint32_t type = word_at(bytes, at + 4);
        at += 8;
        if (length > size - at) fail("a chunk reaches past its end");
        const std::string_view chunk = bytes.substr(at, length);
        if (type == json_chunk && json.empty()) json = chunk;
        if (type == binary_chunk && !binary_) binary_ = std::string(chunk);
        at += length;
    }
    if (json.empty()) fail("it has no JSON chunk");
    return json;
}

void GltfDocument::parse_json(std::string_view text) {
    try {
        json_ = Json::parse(text.begin(), text.end());
    } catch (const Json::parse_error& error) {
        const std::size_t at = std::min(error.byte, text.size());
        const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
        throw invalid_input("not a whole glTF file (line " + std::to_string(line) + " is not JSON)");
    } catch (const Json::exception&) { throw invalid_input("its JSON has a number that is out of range; correct it"); }
}

void GltfDocument::require_version() const {
    const JsonObject asset = root().object("asset");
    const Json* written = asset.find("version");
    // glTF 1.0 allowed a number.
    const std::string version = written && written->is_number() ? written->dump() : asset.text("version");
    if (version.empty()) throw invalid_input("not a glTF 2.0 file (asset.version is missing)");
    if (!version.starts_with("2.")) throw invalid_input("is glTF " + excerpt(version) + "; convert it to glTF 2.0");
    const std::string least = asset.text("minVersion", "2.0");
    if (least != "2.0") throw invalid_input("needs glTF " + excerpt(least) + "; convert it to glTF 2.0");
}

void GltfDocument::require_extensions() const {
    for (const Json& value : root().list("extensionsRequired")) {
        if (!value.is_string()) root().refuse("extensionsRequired", "an array of names");
        const auto name = value.get<std::string>();
        const Substitute* substitute = substitute_for(name);
        if (is_supported(name) || (substitute && substitute->may_be_required)) continue;
        throw invalid_input("requires the extension " + excerpt(name) + ", which is not supported; export without it");
    }
}

void GltfDocument::note_extensions(LeftOutList& left_out) const {
    std::set<std::string> names = extensions_in(json_);
    for (const Json& value : root().list("extensionsUsed")) {
        if (value.is_string()) names.insert(value.get<std::string>());
    }
    for (const std::string& name : names) {
        if (is_supported(name)) continue;
        const Substitute* substitute = substitute_for(name);
        leave_out(left_out, "the extension " + excerpt(name), substitute ? substitute->what : "not supported");
    }
}

JsonObject GltfDocument::element(const char* key, std::size_t index, const std::string& what) const {
    const Json& all = root().list(key);
    if (index >= all.size()) {
        throw invalid_input(what + " " + std::to_string(index) + " does not exist; the file is damaged");
    }
    const Json& json = all[index];
    const std::string numbered = what + " " + std::to_string(index);
    const std::string name = JsonObject(json, numbered).text("name");
    return {json, name.empty() ? numbered : what + " '" + excerpt(name) + "'"};
}

std::string GltfDocument::resource(const std::string& uri) const {
    if (!is_data_uri(uri)) {
        const std::string name = percent_decoded(uri);
        const auto path = files_.find(folder_, name);
        if (!path && excerpt(name, longest_name) != name) {
            throw invalid_input("the URI '" + excerpt(uri) + "' is not the name of a file; correct it");
        }
        return files_.read(path.value_or(folder_ / name));
    }
    auto data = data_of_uri(uri);
    if (!data) throw invalid_input("a data URI is damaged; export the file again");
    return std::move(*data);
}

const std::string& GltfDocument::buffer(std::size_t index) {
    const JsonObject source = element("buffers", index, "buffer");
    auto& buffer = buffers_[index];
    if (buffer) return *buffer;
    const std::size_t size = source.needed("byteLength");
    if (source.has("uri")) {
        buffer = resource(source.text("uri"));
    } else if (index == 0 && binary_) {
        buffer = std::move(*binary_);
    } else if (source.extension("EXT_meshopt_compression")) {
        source.fail("its data is compressed by EXT_meshopt_compression alone, which is not supported; export without");
    } else {
        source.fail("it names no data; the file is damaged");
    }
    if (buffer->size() < size) {
        const std::size_t there = buffer->size();
        buffer.reset();
        source.fail("it has " + std::to_string(there) + " of its " + std::to_string(size) + " bytes; it is cut off");
    }
    buffer->resize(size);
    return *buffer;
}

std::string_view GltfDocument::view(std::size_t index) {
    const JsonObject source = element("bufferViews", index, "bufferView");
    const std::string_view data = buffer(source.needed("buffer"));
    const std::size_t offset = source.whole_number("byteOffset", 0);
    const std::size_t size = source.needed("byteLength");
    if (offset > data.size() || size > data.size() - offset) {
        source.fail("it reaches past the end of its buffer; the file is damaged");
    }
    return data.substr(offset, size);
}

}  // namespace render
