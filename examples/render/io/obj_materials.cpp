#include "io/obj_materials.hpp"

#include <algorithm>
#include <limits>

#include <glm/common.hpp>
#include <lightcuts/core/invalid_input.hpp>

#include "io/escape.hpp"
#include "io/obj_lines.hpp"
#include "io/text_file.hpp"
#include "luminance.hpp"
#include "surfaces/reflectance.hpp"
#include "surfaces/texture.hpp"

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
        const bool gray = t.r == t.g && t.g == t.b;
        switch (channel) {
            case 'r': t.a = t.r; break;
            case 'g': t.a = t.g; break;
            case 'b': t.a = t.b; break;
            default: t.a = gray ? t.r : luminance(glm::vec3(t));
        }
    }
}

/// Base and gain of -mm; what a float cannot hold is cut off.
void modify_range(Texture& texture, double base, double gain) {
    constexpr auto most = static_cast<double>(std::numeric_limits<float>::max());
    for (glm::vec4& t : texture.texels) {
        for (int c = 0; c < 3; ++c) {
            t[c] = static_cast<float>(std::clamp(base + gain * static_cast<double>(t[c]), 0.0, most));
        }
    }
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
    if (!missing_.empty()) replace_missing_libraries();
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
    std::string_view missing;
    const auto note_missing = [&] {
        if (!missing.empty()) missing_.push_back({std::string(missing), names.line});
        missing = {};
    };
    for (std::size_t begin = 0; begin < words.size();) {
        std::optional<std::filesystem::path> path;
        std::size_t end = words.size();
        for (; end > begin && !path; --end) {
            const char* last = words[end - 1].data() + words[end - 1].size();
            path = files_.find(folder, {words[begin].data(), static_cast<std::size_t>(last - words[begin].data())});
        }
        if (path) {
            note_missing();
            found.push_back(*path);
            begin = end + 1;
            continue;
        }
        // Words in a row that lead nowhere may be one name.
        const char* first = missing.empty() ? words[begin].data() : missing.data();
        missing = {first, static_cast<std::size_t>(words[begin].data() + words[begin].size() - first)};
        ++begin;
    }
    note_missing();
    return found;
}

/// Names the libraries that are not there. Where the others lack a material, one that has the name of the OBJ file
/// itself is read last.
void ObjMaterials::replace_missing_libraries() {
    const bool lacks = std::any_of(geometry_.materials.begin(), geometry_.materials.end(),
                                   [&](const ObjName& use) { return !use.name.empty() && !find(use.name); });
    std::string why = "it is not there";
    if (lacks) {
        if (const auto path = files_.find(obj_.parent_path(), obj_.stem().string() + ".mtl")) {
            why += "; " + path->filename().string() + " is used for what the others lack";
            const bool known = std::any_of(libraries_.begin(), libraries_.end(),
                                           [&](const MtlLibrary& library) { return library.path == *path; });
            if (!known) read_library(*path);
        }
    }
    for (const ObjName& name : missing_) {
        leave_out(scene_.left_out, "the material library '" + excerpt(name.name) + "'", why);
    }
}

void ObjMaterials::read_library(const std::filesystem::path& path) {
    const std::size_t place = libraries_.size();
    libraries_.push_back(parse_mtl(path, files_.read(path)));
    const MtlLibrary& library = libraries_.back();
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
        const std::string name = "the material '" + excerpt(use.name) + "'";
        if (!missing_.empty()) {
            fail_at(obj_, missing_.front().line,
                    "the material library '" + excerpt(missing_.front().name) + "' is not there, and no other has " +
                        name + " of line " + std::to_string(use.line) + "; put it beside the OBJ file");
        }
        if (libraries_.empty()) {
            leave_out(scene_.left_out, "materials", "the OBJ file names no library with 'mtllib'");
            return add_default();
        }
        fail_at(obj_, use.line, name + " is in no library; add it or correct the name");
    }
    const MtlLibrary& library = libraries_[place->first];
    library_ = library.path;
    const MtlMaterial& source = library.materials[place->second];
    if (!source.problem.empty()) throw lightcuts::invalid_input(source.problem);
    name_left_out(source);
    scene_.materials.push_back(convert(source));
    return static_cast<std::uint32_t>(scene_.materials.size() - 1);
}

void ObjMaterials::name_left_out(const MtlMaterial& source) {
    for (const LeftOut& item : source.left_out) leave_out(scene_.left_out, item.what, item.why);
    const std::string file = library_.filename().string();
    for (const MtlUnknown& unknown : source.unknown) {
        if (!unknown_.emplace(library_, in_lower_case(unknown.keyword)).second) continue;
        leave_out(scene_.left_out, "'" + excerpt(unknown.keyword) + "' in " + file + ":" + std::to_string(unknown.line),
                  "such statements are unknown");
    }
    for (const auto* map : {&source.diffuse_map, &source.specular_map, &source.emission_map, &source.normal_map}) {
        if (*map && (*map)->channel != '\0') {
            leave_out(scene_.left_out, "-imfchan in " + file + ":" + std::to_string((*map)->line),
                      "only of map_d one channel is used");
        }
    }
}

void ObjMaterials::note_no_uv(std::uint32_t material) {
    lacks_uv_.resize(scene_.materials.size());
    if (lacks_uv_[material]) return;
    lacks_uv_[material] = true;
    const Material& m = scene_.materials[material];
    const auto uses = textures_of(m);
    if (std::none_of(uses.begin(), uses.end(), [](const TextureUse* use) { return use->is_there(); })) return;
    leave_out(scene_.left_out, "where on some faces of '" + m.name + "' its textures lie", "they have no vt");
}

std::uint32_t ObjMaterials::add_default() {
    if (!default_) {
        default_ = static_cast<std::uint32_t>(scene_.materials.size());
        Material gray;
        gray.name = "default";
        gray.model = Material::Model::phong;
        if (!geometry_.colors.empty()) gray.base_color = white;  // times the vertices' colors
        scene_.materials.push_back(gray);
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
    const bool is_tinted = source.filter && *source.filter != black && *source.filter != white;
    if (illumination != 7 && is_tinted) leave_out(scene_.left_out, "Tf of '" + m.name + "'", "glass is illum 7");
    switch (illumination) {
        case 5: return convert_mirror(source, m);
        case 7: return convert_glass(source, m);
        default: return convert_phong(source, illumination, m);
    }
}

void ObjMaterials::convert_mirror(const MtlMaterial& source, Material& m) {
    m.model = Material::Model::mirror;
    m.base_color = source.specular.value_or(source.specular_map ? white : black);
    if (m.base_color != black) m.base_color_texture = texture(source.specular_map, Role::opaque_color);
    if (source.diffuse.value_or(black) != black || source.diffuse_map) {
        leave_out(scene_.left_out, "Kd and map_Kd of '" + m.name + "'", "a mirror, illum 5, reflects by Ks alone");
    }
    convert_opacity(source, m);
}

void ObjMaterials::convert_glass(const MtlMaterial& source, Material& m) {
    const glm::vec3 filter = source.filter.value_or(black);
    m.model = Material::Model::glass;
    m.base_color = filter == black ? white : filter;
    m.ior = source.ior.value_or(1.0f);
    m.transmission = 1.0f;
    std::string ignored;
    const auto ignore = [&](bool is_there, const char* keyword) {
        if (is_there) ignored += (ignored.empty() ? "" : ", ") + std::string(keyword);
    };
    ignore(source.diffuse.value_or(black) != black, "Kd");
    ignore(source.diffuse_map.has_value(), "map_Kd");
    ignore(source.specular.value_or(black) != black && source.specular.value_or(black) != white, "Ks");
    ignore(source.specular_map.has_value(), "map_Ks");
    ignore(m.base_alpha < 1.0f, source.dissolve ? "d" : "Tr");
    ignore(source.dissolve_map.has_value(), "map_d");
    m.base_alpha = 1.0f;
    if (ignored.empty()) return;
    leave_out(scene_.left_out, ignored + " of '" + m.name + "'", "glass, illum 7, is told by Ni and Tf alone");
}

void ObjMaterials::convert_phong(const MtlMaterial& source, int illumination, Material& m) {
    if (illumination > 2) {
        leave_out(scene_.left_out, "reflection or refraction of illum " + std::to_string(illumination),
                  "mirrors are illum 5, glass is illum 7");
    }
    m.model = Material::Model::phong;
    m.base_color = source.diffuse.value_or(source.diffuse_map ? white : black);
    m.base_color_texture = texture(source.diffuse_map, Role::color);
    const glm::vec3 specular = source.specular.value_or(source.specular_map ? white : black);
    if (illumination >= 2 && m.exponent > 0.0f) {
        m.specular = specular;
        if (m.specular != black) m.specular_texture = texture(source.specular_map, Role::opaque_color);
    } else if (illumination < 2 && source.specular_map) {
        leave_out(scene_.left_out, "map_Ks of '" + m.name + "'", "illum 0 and 1 have no gloss");
    } else if (illumination >= 2 && specular != black) {
        leave_out(scene_.left_out, "Ks of '" + m.name + "'", "where Ns is 0, there is no gloss");
    }
    convert_opacity(source, m);
}

void ObjMaterials::convert_opacity(const MtlMaterial& source, Material& m) {
    m.alpha_texture = texture(source.dissolve_map, Role::alpha);
    const TextureUse& alpha = m.alpha_texture.is_there() ? m.alpha_texture : m.base_color_texture;
    const bool holes = alpha.is_there() && has_holes(scene_.textures[static_cast<std::size_t>(alpha.texture)]);
    if (m.base_alpha < 1.0f || holes) m.alpha = Material::Alpha::blend;
}

TextureUse ObjMaterials::texture(const std::optional<MtlMap>& map, Role role) {
    if (!map) return {};
    return {load_texture(*map, role), 0, transform_of(*map)};
}

std::filesystem::path ObjMaterials::path_of(const MtlMap& map) {
    const auto find = [&](std::string_view name) -> std::optional<std::filesystem::path> {
        for (const std::filesystem::path& folder : {library_.parent_path(), obj_.parent_path()}) {
            if (auto path = files_.find(folder, name)) return path;
        }
        return std::nullopt;
    };
    // Beside the library or the OBJ file.
    for (const std::string_view name : {std::string_view(map.file), without_comment(map.file)}) {
        if (const auto path = find(name)) return *path;
    }
    // Exporters write paths of their author's disk, too.
    const std::size_t separator = map.file.find_last_of("/\\");
    if (separator != std::string::npos) {
        if (const auto path = find(std::string_view(map.file).substr(separator + 1))) {
            leave_out(scene_.left_out, "the folder of the texture '" + excerpt(map.file) + "'",
                      "the file is not there; one of the same name beside the scene is used");
            return *path;
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
    if (is_new) scene_.textures.push_back(read_map(path, map, role));
    return entry->second;
}

Texture ObjMaterials::read_map(const std::filesystem::path& path, const MtlMap& map, Role role) {
    const bool is_color = role == Role::color || role == Role::opaque_color || role == Role::emission;
    const bool is_radiance = role == Role::emission;
    Texture texture;
    try {
        texture = texture_of_bytes(files_.read(path), path.string(), is_color,
                                   is_radiance ? Premultiplication::keep : Premultiplication::undo);
    } catch (const lightcuts::invalid_input& problem) { fail_at(library_, map.line, problem.what()); }
    texture.name = path.filename().string();
    if (map.base != 0.0 || map.gain != 1.0) modify_range(texture, map.base, map.gain);
    if (role == Role::alpha) make_mask(texture, map.channel);
    if (role == Role::opaque_color) {
        for (glm::vec4& texel : texture.texels) texel.a = 1.0f;
    }
    if (!is_radiance) clip_reflectance(texture, scene_.left_out);
    if (map.clamp) texture.wrap_u = texture.wrap_v = Texture::Wrap::clamp;
    return texture;
}

}  // namespace render
