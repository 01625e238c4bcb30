#include "io/obj_materials.hpp"

#include <algorithm>

#include <glm/common.hpp>
#include <lightcuts/core/invalid_input.hpp>

#include "escape.hpp"
#include "io/obj_lines.hpp"
#include "luminance.hpp"
#include "text_file.hpp"
#include "texture.hpp"

namespace render {
namespace {

constexpr glm::vec3 black(0.0f);
constexpr glm::vec3 white(1.0f);

bool has_holes(const Texture& texture) {
    return std::any_of(texture.texels.begin(), texture.texels.end(), [](const glm::vec4& t) { return t.a < 1.0f; });
}

/// What `channel`, an argument of -imfchan, selects; else alpha if the picture has any, brightness if not.
void make_mask(Texture& texture, char channel) {
    if (channel == 'm' || channel == 'z' || (channel == '\0' && has_holes(texture))) return;
    for (glm::vec4& t : texture.texels) {
        const bool grey = t.r == t.g && t.g == t.b;
        switch (channel) {
            case 'r': t.a = t.r; break;
            case 'g': t.a = t.g; break;
            case 'b': t.a = t.b; break;
            default: t.a = grey ? t.r : luminance(glm::vec3(t));
        }
    }
}

/// Base and gain of -mm.
void modify_range(Texture& texture, double base, double gain) {
    for (glm::vec4& t : texture.texels) {
        for (int c = 0; c < 3; ++c) {
            t[c] = static_cast<float>(std::max(0.0, base + gain * static_cast<double>(t[c])));
        }
    }
}

bool clip_to_one(Texture& texture) {
    bool any = false;
    for (glm::vec4& t : texture.texels) {
        any = any || t.r > 1.0f || t.g > 1.0f || t.b > 1.0f;
        t = glm::min(t, glm::vec4(1.0f));
    }
    return any;
}

/// OBJ's v runs upwards, a texture's downwards.
UvTransform transform_of(const MtlMap& map) {
    UvTransform t;
    t.offset = glm::vec2(glm::dvec2(map.offset.x, 1.0 - map.scale.y - map.offset.y));
    t.u_axis = {static_cast<float>(map.scale.x), 0.0f};
    t.v_axis = {0.0f, static_cast<float>(map.scale.y)};
    return t;
}

}  // namespace

ObjMaterials::ObjMaterials(std::filesystem::path obj, const ObjGeometry& geometry, const FileSource& files,
                           Scene& scene)
    : obj_(std::move(obj)), geometry_(geometry), files_(files), scene_(scene), added_(geometry.materials.size()) {
    for (const ObjName& names : geometry.libraries) read_libraries(names);
}

void ObjMaterials::read_libraries(const ObjName& names) {
    for (const std::filesystem::path& path : find_libraries(names)) {
        const bool known = std::any_of(libraries_.begin(), libraries_.end(),
                                       [&](const MtlLibrary& library) { return library.path == path; });
        if (!known) read_library(path);
    }
}

/// A line of `mtllib` names one file, whose name may have blanks, or several: of the ways to read it, the one whose
/// names are longest.
std::vector<std::filesystem::path> ObjMaterials::find_libraries(const ObjName& names) {
    const std::filesystem::path folder = obj_.parent_path();
    for (const std::string_view text : {std::string_view(names.name), without_comment(names.name)}) {
        if (const auto path = files_.find(folder, text)) return {*path};
    }
    std::vector<std::filesystem::path> found;
    std::vector<std::string_view> words;
    split_before_comment(names.name, words);
    if (words.empty()) fail_at(obj_, names.line, "'mtllib' names no file; name one or remove the line");
    for (std::size_t begin = 0; begin < words.size();) {
        std::optional<std::filesystem::path> path;
        std::size_t end = words.size();
        for (; end > begin && !path; --end) {
            const char* last = words[end - 1].data() + words[end - 1].size();
            path = files_.find(folder, {words[begin].data(), static_cast<std::size_t>(last - words[begin].data())});
        }
        if (!path) return {library_of_same_name(names, words.size() == 1 ? words[begin] : names.name)};
        found.push_back(*path);
        begin = end + 1;
    }
    return found;
}

/// The library that has the name of the OBJ file itself, where the one that is named is missing.
std::filesystem::path ObjMaterials::library_of_same_name(const ObjName& names, std::string_view missing) {
    const std::string name = "the material library '" + excerpt(missing) + "'";
    const auto path = files_.find(obj_.parent_path(), obj_.stem().string() + ".mtl");
    if (!path) fail_at(obj_, names.line, name + " is not there; put it beside the OBJ file or remove the line");
    leave_out(scene_.left_out, name, "it is not there; " + path->filename().string() + " is used");
    return *path;
}

void ObjMaterials::read_library(const std::filesystem::path& path) {
    const std::size_t place = libraries_.size();
    libraries_.push_back(parse_mtl(path, files_.read(path)));
    const MtlLibrary& library = libraries_.back();
    for (const LeftOut& item : library.left_out) leave_out(scene_.left_out, item.what, item.why);
    // The first of a name counts. One that has a comment behind it can be used with or without.
    for (std::size_t i = 0; i < library.materials.size(); ++i)
        by_name_.try_emplace(library.materials[i].name, place, i);
    for (std::size_t i = 0; i < library.materials.size(); ++i) {
        by_name_.try_emplace(std::string(without_comment(library.materials[i].name)), place, i);
    }
}

const std::pair<std::size_t, std::size_t>* ObjMaterials::find(const std::string& name) const {
    auto found = by_name_.find(name);
    if (found == by_name_.end()) found = by_name_.find(std::string(without_comment(name)));
    return found == by_name_.end() ? nullptr : &found->second;
}

std::uint32_t ObjMaterials::in_scene(std::int32_t use) {
    if (use < 0) return add_default();
    auto& added = added_[static_cast<std::size_t>(use)];
    if (!added) added = add(geometry_.materials[static_cast<std::size_t>(use)]);
    return *added;
}

std::uint32_t ObjMaterials::add(const ObjName& use) {
    const auto* place = find(use.name);
    if (!place) {
        if (use.name.empty()) return add_default();
        if (libraries_.empty()) {
            leave_out(scene_.left_out, "materials", "the OBJ file names no library with 'mtllib'");
            return add_default();
        }
        fail_at(obj_, use.line,
                "the material '" + excerpt(use.name) + "' is in no library; add it or correct the name");
    }
    const MtlLibrary& library = libraries_[place->first];
    library_ = library.path;
    scene_.materials.push_back(convert(library.materials[place->second]));
    return static_cast<std::uint32_t>(scene_.materials.size() - 1);
}

std::uint32_t ObjMaterials::add_default() {
    if (!default_) {
        default_ = static_cast<std::uint32_t>(scene_.materials.size());
        Material grey;
        grey.name = "default";
        grey.model = Material::Model::phong;
        if (!geometry_.colors.empty()) grey.base_color = white;  // times the vertices' colours
        scene_.materials.push_back(grey);
    }
    return *default_;
}

Material ObjMaterials::convert(const MtlMaterial& source) {
    Material m;
    m.name = source.name;
    m.emission = source.emission.value_or(source.emission_map ? white : black);
    if (m.emission != black) m.emission_texture = texture(source.emission_map, Role::emission);
    m.normal_texture = texture(source.normal_map, Role::data);
    convert_model(source, m);
    return m;
}

void ObjMaterials::convert_model(const MtlMaterial& source, Material& m) {
    const int illumination = source.illumination.value_or(2);
    m.exponent = source.exponent.value_or(1.0f);
    m.base_alpha = std::min(source.dissolve.value_or(1.0f - std::min(source.transparency.value_or(0.0f), 1.0f)), 1.0f);
    if (illumination == 5) {
        m.model = Material::Model::mirror;
        m.base_color = source.specular.value_or(black);
        return;
    }
    if (illumination == 7) {
        const glm::vec3 filter = source.filter.value_or(black);
        m.model = Material::Model::glass;
        m.base_color = filter == black ? white : filter;
        m.ior = source.ior.value_or(1.0f);
        m.transmission = 1.0f;
        return;
    }
    if (illumination > 2) {
        leave_out(scene_.left_out, "reflection or refraction of illum " + std::to_string(illumination),
                  "mirrors are illum 5, glass is illum 7");
    }
    m.model = Material::Model::phong;
    m.base_color = source.diffuse.value_or(source.diffuse_map ? white : black);
    m.base_color_texture = texture(source.diffuse_map, Role::color);
    if (illumination >= 2 && m.exponent > 0.0f) {
        m.specular = source.specular.value_or(source.specular_map ? white : black);
        if (m.specular != black) m.specular_texture = texture(source.specular_map, Role::color);
    }
    convert_cover(source, m);
}

void ObjMaterials::convert_cover(const MtlMaterial& source, Material& m) {
    m.alpha_texture = texture(source.dissolve_map, Role::alpha);
    const TextureUse& alpha = m.alpha_texture.is_there() ? m.alpha_texture : m.base_color_texture;
    const bool holes = alpha.is_there() && has_holes(scene_.textures[static_cast<std::size_t>(alpha.texture)]);
    if (m.base_alpha < 1.0f || holes) m.alpha = Material::Alpha::blend;
}

TextureUse ObjMaterials::texture(const std::optional<MtlMap>& map, Role role) {
    if (!map) return {};
    return {load_texture(*map, role), 0, transform_of(*map)};
}

std::filesystem::path ObjMaterials::path_of(const MtlMap& map) const {
    // Beside the library or the OBJ file; exporters write paths of their author's disk, too.
    const std::size_t separator = map.file.find_last_of("/\\");
    const std::string last = separator == std::string::npos ? map.file : map.file.substr(separator + 1);
    for (const std::string_view name :
         {std::string_view(map.file), without_comment(map.file), std::string_view(last)}) {
        for (const std::filesystem::path& folder : {library_.parent_path(), obj_.parent_path()}) {
            if (const auto path = files_.find(folder, name)) return *path;
        }
    }
    if (map.file.find('\0') != std::string::npos) {
        fail_at(library_, map.line, "'" + excerpt(map.file) + "' is not the name of a file; correct it");
    }
    return library_.parent_path() / map.file;
}

int ObjMaterials::load_texture(const MtlMap& map, Role role) {
    const std::filesystem::path path = path_of(map);
    const auto [entry, is_new] = textures_.try_emplace(
        TextureKey{path, role, map.base, map.gain, map.channel, map.clamp}, static_cast<int>(scene_.textures.size()));
    if (!is_new) return entry->second;
    const bool is_color = role == Role::color || role == Role::emission;
    Texture texture = texture_of_bytes(files_.read(path), path.string(), is_color);
    if (map.base != 0.0 || map.gain != 1.0) modify_range(texture, map.base, map.gain);
    if (role == Role::alpha) make_mask(texture, map.channel);
    if (role != Role::emission && clip_to_one(texture)) {
        leave_out(scene_.left_out, "what is above 1 of the texture '" + path.filename().string() + "'",
                  "a surface reflects no more than it gets");
    }
    if (map.clamp) texture.wrap_u = texture.wrap_v = Texture::Wrap::clamp;
    scene_.textures.push_back(std::move(texture));
    return entry->second;
}

}  // namespace render
