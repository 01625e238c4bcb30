#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "io/file_source.hpp"
#include "io/mtl.hpp"
#include "io/obj_geometry.hpp"
#include "scene.hpp"

namespace render {

/// The materials of an OBJ file's libraries; puts those that faces use into a scene.
class ObjMaterials {
public:
    /// Reads the libraries that `geometry` names. All references must outlive this object.
    /// throws: invalid_input naming the line of a library that is not there, or as parse_mtl.
    ObjMaterials(std::filesystem::path obj, const ObjGeometry& geometry, const FileSource& files, Scene& scene);

    /// Index in the scene of the material of faces with `ObjFace::material` == `use`; added at its first use.
    /// throws: invalid_input naming the line if no library has the name, or the file of a texture that is not there.
    std::uint32_t in_scene(std::int32_t use);

private:
    enum class Role { color, emission, alpha, data };
    using TextureKey = std::tuple<std::filesystem::path, Role, double, double, char, bool>;

    void read_libraries(const ObjName& names);
    void read_library(const std::filesystem::path& path);
    std::vector<std::filesystem::path> find_libraries(const ObjName& names);
    std::filesystem::path library_of_same_name(const ObjName& names, std::string_view missing);
    const std::pair<std::size_t, std::size_t>* find(const std::string& name) const;
    std::uint32_t add(const ObjName& use);
    std::uint32_t add_default();
    Material convert(const MtlMaterial& source);
    void convert_model(const MtlMaterial& source, Material& material);
    void convert_cover(const MtlMaterial& source, Material& material);
    TextureUse texture(const std::optional<MtlMap>& map, Role role);
    int load_texture(const MtlMap& map, Role role);
    std::filesystem::path path_of(const MtlMap& map) const;

    std::filesystem::path obj_;
    const ObjGeometry& geometry_;
    const FileSource& files_;
    Scene& scene_;
    std::vector<MtlLibrary> libraries_;
    std::map<std::string, std::pair<std::size_t, std::size_t>> by_name_;  ///< place of the library and in it
    std::vector<std::optional<std::uint32_t>> added_;                     ///< in the scene, by use
    std::optional<std::uint32_t> default_;
    std::filesystem::path library_;  ///< of the material that is being converted
    std::map<TextureKey, int> textures_;
};

}  // namespace render
