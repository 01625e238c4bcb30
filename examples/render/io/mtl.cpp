#include "io/mtl.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include <glm/common.hpp>
#include <lightcuts/core/invalid_input.hpp>

#include "io/escape.hpp"
#include "io/obj_lines.hpp"
#include "io/text_file.hpp"
#include "surfaces/reflectance.hpp"

namespace render {
namespace {

/// What a keyword's part of a material says, and why the picture does not show it.
struct IgnoredKeyword {
    std::string_view keyword;  ///< in lower case
    const char* why;           ///< null: the picture is the same without it
};

constexpr const char* not_supported = "not supported";
constexpr std::array ignored_keywords{
    IgnoredKeyword{"ka", nullptr},  // ambient light is what this renderer computes
    IgnoredKeyword{"map_ka", nullptr},
    IgnoredKeyword{"map_aat", nullptr},
    IgnoredKeyword{"sharpness", nullptr},
    IgnoredKeyword{"map_ns", not_supported},
    IgnoredKeyword{"bump", not_supported},
    IgnoredKeyword{"map_bump", not_supported},
    IgnoredKeyword{"disp", not_supported},
    IgnoredKeyword{"map_disp", not_supported},
    IgnoredKeyword{"decal", not_supported},
    IgnoredKeyword{"refl", "reflections are computed"},
    IgnoredKeyword{"map_refl", "reflections are computed"},
    IgnoredKeyword{"pr", not_supported},
    IgnoredKeyword{"map_pr", not_supported},
    IgnoredKeyword{"pm", not_supported},
    IgnoredKeyword{"map_pm", not_supported},
    IgnoredKeyword{"ps", not_supported},
    IgnoredKeyword{"map_ps", not_supported},
    IgnoredKeyword{"pc", not_supported},
    IgnoredKeyword{"pcr", not_supported},
    IgnoredKeyword{"aniso", not_supported},
    IgnoredKeyword{"anisor", not_supported},
};

/// Linear Rec. 709 of CIE coordinates; what a display cannot show is cut off.
glm::vec3 rgb_of_xyz(const glm::dvec3& v) {
    return glm::max(glm::vec3(glm::dvec3(3.2404542 * v.x - 1.5371385 * v.y - 0.4985314 * v.z,
                                         -0.9692660 * v.x + 1.8760108 * v.y + 0.0415560 * v.z,
                                         0.0556434 * v.x - 0.2040259 * v.y + 1.0572252 * v.z)),
                    glm::vec3(0.0f));
}

class MtlParser {
public:
    MtlParser(const std::filesystem::path& path, std::string_view text) {
        library_.path = path;
        ObjLines lines(path, text);
        ObjStatement statement;
        while (lines.next(statement)) {
            line_ = statement.line;
            parse(statement);
        }
    }

    MtlLibrary take() { return std::move(library_); }

private:
    [[noreturn]] void fail(const std::string& problem) const { fail_at(library_.path, line_, problem); }

    void parse(const ObjStatement& statement) {
        const std::string keyword = in_lower_case(statement.keyword);
        if (keyword == "newmtl") {
            MtlMaterial& material = library_.materials.emplace_back();
            material.name = statement.rest;
            material.line = line_;
            unknown_.clear();
            return;
        }
        // Ignored: what comes before the first `newmtl`, and the rest of a material that has an error already.
        if (library_.materials.empty() || !material().problem.empty()) return;
        try {
            parse(keyword, statement);
        } catch (const lightcuts::invalid_input& problem) { material().problem = problem.what(); }
    }

    void parse(const std::string& keyword, const ObjStatement& statement) {
        MtlMaterial& m = material();
        if (keyword == "kd") {
            m.diffuse = reflectance(statement);
        } else if (keyword == "ks") {
            m.specular = reflectance(statement);
        } else if (keyword == "tf") {
            m.filter = reflectance(statement);
        } else if (keyword == "ke") {
            m.emission = color(statement);
        } else if (keyword == "ns") {
            m.exponent = number(statement);
        } else if (keyword == "ni") {
            m.ior = number(statement);
        } else if (keyword == "d") {
            m.dissolve = dissolve(statement);
        } else if (keyword == "tr") {
            m.transparency = number(statement);
        } else if (keyword == "illum") {
            m.illumination = static_cast<int>(std::lround(std::min(number(statement), 1e6f)));
        } else if (keyword == "map_kd") {
            m.diffuse_map = map(statement);
        } else if (keyword == "map_ks") {
            m.specular_map = map(statement);
        } else if (keyword == "map_ke") {
            m.emission_map = map(statement);
        } else if (keyword == "map_d") {
            m.dissolve_map = map(statement);
        } else if (keyword == "norm") {
            m.normal_map = map(statement);
        } else {
            ignore(keyword, statement.keyword);
        }
    }

    void ignore(const std::string& keyword, std::string_view as_written) {
        const auto known = std::find_if(ignored_keywords.begin(), ignored_keywords.end(),
                                        [&](const IgnoredKeyword& k) { return k.keyword == keyword; });
        if (known == ignored_keywords.end()) {
            if (unknown_.insert(keyword).second) material().unknown.push_back({std::string(as_written), line_});
        } else if (known->why) {
            leave_out(material().left_out, std::string(as_written) + " of materials", known->why);
        }
    }

    MtlMaterial& material() { return library_.materials.back(); }

    std::string place() const { return library_.path.filename().string() + ":" + std::to_string(line_); }

    float number(std::string_view word) const {
        const auto value = parse_number(word);
        const bool usable = value && std::isfinite(static_cast<float>(*value)) && *value >= 0.0;
        if (!usable) fail("'" + excerpt(word) + "' is not a finite positive number; correct it");
        return static_cast<float>(*value);
    }

    float number(const ObjStatement& statement) {
        split_before_comment(statement.rest, words_);
        if (words_.empty()) fail("'" + std::string(statement.keyword) + "' needs a number; the line is broken");
        return number(words_[0]);
    }

    /// `-halo` makes it depend on the angle of view.
    float dissolve(const ObjStatement& statement) {
        split_before_comment(statement.rest, words_);
        if (!words_.empty() && words_[0] == "-halo") {
            leave_out(material().left_out, "-halo of materials", "opacity does not depend on the angle of view");
            words_.erase(words_.begin());
        }
        if (words_.empty()) fail("'d' needs a number; the line is broken or cut off");
        return number(words_[0]);
    }

    glm::vec3 color(const ObjStatement& statement) {
        split_before_comment(statement.rest, words_);
        if (!words_.empty() && words_[0] == "spectral") {
            fail("spectral reflectance files cannot be read; give " + std::string(statement.keyword) + " r g b");
        }
        const bool is_xyz = !words_.empty() && words_[0] == "xyz";
        if (is_xyz) words_.erase(words_.begin());
        if (words_.empty() || words_.size() == 2) {
            fail("'" + std::string(statement.keyword) +
                 "' needs 3 numbers, or 1 for all; the line is broken or cut off");
        }
        glm::vec3 v(0.0f);
        for (std::size_t i = 0; i < 3; ++i) v[static_cast<int>(i)] = number(words_[words_.size() > 1 ? i : 0]);
        return is_xyz ? rgb_of_xyz(v) : v;
    }

    glm::vec3 reflectance(const ObjStatement& statement) {
        glm::vec3 v = color(statement);
        clip_reflectance(v, std::string(statement.keyword) + " in " + place(), material().left_out);
        return v;
    }

    /// Options, then the name of a file, which may have blanks.
    MtlMap map(const ObjStatement& statement) {
        MtlMap map;
        map.line = line_;
        rest_ = statement.rest;
        while (!rest_.empty() && rest_.front() == '-') {
            const std::string_view before = rest_;
            const std::string option = in_lower_case(take_word());
            if (!read_option(option, map)) {
                rest_ = before;  // a name that begins with a minus sign
                break;
            }
        }
        map.file = rest_;
        if (map.file.empty())
            fail("'" + std::string(statement.keyword) + "' names no file; name one or remove the line");
        return map;
    }

    bool read_option(const std::string& option, MtlMap& map) {
        if (option == "-o") {
            map.offset = take_pair(0.0);
        } else if (option == "-s") {
            map.scale = take_pair(1.0);
        } else if (option == "-t") {
            take_pair(0.0);
            leave_out(material().left_out, "-t of maps", "textures have no turbulence");
        } else if (option == "-mm") {
            map.base = take_number();
            map.gain = take_number();
        } else if (option == "-clamp") {
            map.clamp = take_word() == "on";
        } else if (option == "-imfchan") {
            const std::string_view channel = take_word();
            map.channel = channel.empty() ? '\0' : in_lower_case(channel.substr(0, 1))[0];
        } else if (option == "-blendu" || option == "-blendv" || option == "-cc" || option == "-texres") {
            take_word();  // how a texture is filtered or coded
        } else if (option == "-boost" || option == "-bm" || option == "-type") {
            take_word();
            leave_out(material().left_out, option + " of maps", not_supported);
        } else {
            return false;
        }
        return true;
    }

    std::string_view take_word() {
        const std::size_t end = std::min(rest_.find_first_of(" \t"), rest_.size());
        const std::string_view word = rest_.substr(0, end);
        rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t", end), rest_.size()));
        return word;
    }

    double take_number() {
        const std::string_view word = take_word();
        const auto value = parse_number(word);
        if (!value || !std::isfinite(static_cast<float>(*value))) {
            fail("'" + excerpt(word) + "' is not a finite number; correct it");
        }
        return *value;
    }

    /// u, and maybe v and w; what is not there is `otherwise`.
    glm::dvec2 take_pair(double otherwise) {
        glm::dvec2 pair(take_number(), otherwise);
        for (int i = 1; i < 3; ++i) {
            const std::string_view before = rest_;
            const auto value = parse_number(take_word());
            // A last word that looks like a number is the file's name.
            if (!value || !std::isfinite(static_cast<float>(*value)) || rest_.empty()) {
                rest_ = before;
                break;
            }
            if (i == 1) pair.y = *value;
        }
        return pair;
    }

    MtlLibrary library_;
    std::size_t line_ = 0;
    std::vector<std::string_view> words_;
    std::string_view rest_;
    std::set<std::string> unknown_;  ///< keywords of the last material
};

}  // namespace

MtlLibrary parse_mtl(const std::filesystem::path& path, std::string_view text) { return MtlParser(path, text).take(); }

}  // namespace render
