#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
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
    /// throws: invalid_input naming the line of an `mtllib` that names nothing, or as parse_mtl.
    ObjMaterials(std::filesystem::path obj, const ObjGeometry& geometry, const FileSource& files, Scene& scene);

    /// Index in the scene of the material of faces with `ObjFace::material` == `use`; added at its first use.
    /// throws: invalid_input naming the line if no library has the name, the line of the library's that is wrong, or
    /// that of a map whose texture is not there or cannot be read.
    std::uint32_t in_scene(std::int32_t use);

    /// Notes that a face of this material of the scene says nowhere where its textures lie. Cheap.
    void note_no_uv(std::uint32_t material);

private:
    /// What a texture's texels are: reflectance; the same without its alpha; emitted radiance; opacity; numbers.
    enum class Role { color, opaque_color, emission, alpha, data };
    using TextureKey = std::tuple<std::filesystem::path, Role, double, double, char, bool>;

    void read_libraries(const ObjName& names);
    void read_library(const std::filesystem::path& path);
    std::vector<std::filesystem::path> find_libraries(const ObjName& names);
    void replace_missing_libraries();
    const std::pair<std::size_t, std::size_t>* find(const std::string& name) const;
    std::uint32_t add(const ObjName& use);
    std::uint32_t add_default();
    Material convert(const MtlMaterial& source);
    void name_left_out(const MtlMaterial& source);
    void convert_mirror(const MtlMaterial& source, Material& material);
    void convert_glass(const MtlMaterial& source, Material& material);
    void convert_phong(const MtlMaterial& source, int illumination, Material& material);
    void convert_model(const MtlMaterial& source, Material& material);
    void convert_opacity(const MtlMaterial& source, Material& material);
    TextureUse texture(const std::optional<MtlMap>& map, Role role);
    int load_texture(const MtlMap& map, Role role);
    std::filesystem::path path_of(const MtlMap& map);
    Texture read_map(const std::filesystem::path& path, const MtlMap& map, Role role);

    std::filesystem::path obj_;
    const ObjGeometry& geometry_;
    const FileSource& files_;
    Scene& scene_;
    std::vector<MtlLibrary> libraries_;
    std::vector<ObjName> missing_;  ///< libraries that are not there, each with the line that names it
    std::map<std::string, std::pair<std::size_t, std::size_t>> by_name_;  ///< place of the library and in it
    std::vector<std::optional<std::uint32_t>> added_;                     ///< in the scene, by use
    std::optional<std::uint32_t> default_;
    std::filesystem::path library_;  ///< of the material that is being converted
    std::map<TextureKey, int> textures_;
    std::set<std::pair<std::filesystem::path, std::string>> unknown_;  ///< keywords that are named, by library
    std::vector<bool> lacks_uv_;  ///< by material of the scene: that is named, or need not be
};

}  // namespace render
