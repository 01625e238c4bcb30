#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "io/file_source.hpp"
#include "io/json_object.hpp"
#include "io/left_out.hpp"

namespace render {

/// A glTF 2.0 file, .gltf or .glb, with the buffers that it refers to. Buffers are read when they are first asked for.
/// Messages do not name the file itself.
class GltfDocument {
public:
    /// `files` must outlive this object. throws: invalid_input if it is no whole glTF 2.0 file, or if it requires an
    /// extension that is not supported.
    GltfDocument(const std::filesystem::path& path, const FileSource& files);

    JsonObject root() const { return JsonObject(json_, "the file"); }

    /// Element `index` of the file's list `key`; messages call it `what` and by its name or index.
    /// throws: invalid_input if there is none.
    JsonObject element(const char* key, std::size_t index, const std::string& what) const;
    std::size_t count(const char* key) const { return root().list(key).size(); }

    /// Bytes of a bufferView. throws: invalid_input if it does not lie within its buffer, or this cannot be read.
    std::string_view view(std::size_t index);

    /// The file that a URI names. throws: invalid_input as FileSource::read, or if data in it is damaged.
    std::string resource(const std::string& uri) const;

    /// Names the extensions that the file uses and this renderer does not know.
    void note_extensions(LeftOutList& left_out) const;

private:
    void parse(std::string bytes);
    void parse_json(std::string_view text);
    std::string_view split_binary(std::string_view bytes);
    void require_version() const;
    void require_extensions() const;
    const std::string& buffer(std::size_t index);

    const FileSource& files_;
    std::filesystem::path folder_;
    nlohmann::json json_;
    std::optional<std::string> binary_;  ///< of a .glb
    std::vector<std::optional<std::string>> buffers_;
};

}  // namespace render
