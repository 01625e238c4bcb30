#include "io/obj_geometry.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "io/escape.hpp"
#include "io/obj_lines.hpp"
#include "io/text_file.hpp"

namespace render {
namespace {

/// Statements that group or smooth, which say nothing of what a surface looks like.
constexpr std::array<std::string_view, 7> without_effect{"o", "g", "s", "mg", "bevel", "c_interp", "d_interp"};
constexpr std::array<std::string_view, 17> free_form{"vp",    "cstype", "deg",   "bmat", "step", "curv",
                                                     "curv2", "surf",   "parm",  "trim", "hole", "scrv",
                                                     "sp",    "ctech",  "stech", "con",  "end"};

template <std::size_t Count>
bool contains(const std::array<std::string_view, Count>& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

/// The largest index that faces use of a list that may still grow.
struct LargestIndex {
    const char* what;
    std::int32_t index = -1;
    std::size_t line = 0;
};

/// How a face's vertex is written.
struct CornerForm {
    int slashes = 0;
    bool has_uv = false;
    bool has_normal = false;

    bool operator==(const CornerForm&) const = default;
};

class ObjParser {
public:
    ObjParser(const std::filesystem::path& path, std::string_view text) : path_(path) {
        ObjLines lines(path, text);
        ObjStatement statement;
        while (lines.next(statement)) {
            line_ = statement.line;
            parse(statement);
        }
        require_exists(largest_position_, geometry_.positions.size());
        require_exists(largest_uv_, geometry_.uvs.size());
        require_exists(largest_normal_, geometry_.normals.size());
        finish_colors();
    }

    ObjGeometry take() { return std::move(geometry_); }

private:
    [[noreturn]] void fail(const std::string& problem) const { fail_at(path_, line_, problem); }

    void parse(const ObjStatement& statement) {
        const std::string_view keyword = statement.keyword;
        if (keyword == "v") {
            add_position(statement.rest);
        } else if (keyword == "vt") {
            add_uv(statement.rest);
        } else if (keyword == "vn") {
            add_normal(statement.rest);
        } else if (keyword == "f" || keyword == "fo") {
            add_face(statement.rest);
        } else if (keyword == "usemtl") {
            use_material(statement.rest);
        } else if (keyword == "mtllib") {
            geometry_.libraries.push_back({std::string(statement.rest), line_});
        } else if (keyword == "l" || keyword == "p") {
            leave_out(geometry_.left_out, "points and lines", "they have no surface");
        } else if (contains(free_form, keyword)) {
            leave_out(geometry_.left_out, "free-form curves and surfaces", "not supported; export polygons");
        } else if (!contains(without_effect, keyword)) {
            note_unknown(keyword);
        }
    }

    void note_unknown(std::string_view keyword) {
        if (!unknown_.emplace(keyword).second) return;
        leave_out(geometry_.left_out, "'" + excerpt(keyword) + "' in line " + std::to_string(line_),
                  "such statements are unknown");
    }

    /// Fills `numbers_` with all of them. `wanted`: the fewest.
    void read_numbers(std::string_view keyword, std::string_view text, std::size_t wanted) {
        split_before_comment(text, words_);
        if (words_.size() < wanted) {
            fail("'" + std::string(keyword) + "' needs " + std::to_string(wanted) +
                 (wanted == 1 ? " number" : " numbers") + "; the line is broken or cut off");
        }
        numbers_.clear();
        for (const std::string_view word : words_) {
            const auto value = parse_number(word);
            // What a float cannot hold cannot be rendered.
            if (!value || !std::isfinite(static_cast<float>(*value))) {
                fail("'" + excerpt(word) + "' is not a finite number; correct it");
            }
            numbers_.push_back(*value);
        }
    }

    void add_position(std::string_view text) {
        read_numbers("v", text, 3);
        require_room(geometry_.positions.size());
        geometry_.positions.emplace_back(numbers_[0], numbers_[1], numbers_[2]);
        const std::size_t count = numbers_.size();
        if (count == 6) {
            geometry_.colors.resize(geometry_.positions.size() - 1, glm::vec3(1.0f));
            geometry_.colors.emplace_back(numbers_[3], numbers_[4], numbers_[5]);
            const bool negative = numbers_[3] < 0.0 || numbers_[4] < 0.0 || numbers_[5] < 0.0;
            if (negative) fail("a vertex has a negative color; correct it");
        } else if (count > 4 && !std::exchange(has_odd_position_, true)) {
            // The fourth of four is a weight, which polygons ignore.
            leave_out(geometry_.left_out,
                      "what follows x y z of 'v' lines of " + std::to_string(count) + " numbers, such as line " +
                          std::to_string(line_),
                      "only x y z w and x y z r g b say which number is what");
        }
    }

    void add_uv(std::string_view text) {
        read_numbers("vt", text, 1);
        require_room(geometry_.uvs.size());
        geometry_.uvs.emplace_back(numbers_[0], numbers_.size() > 1 ? numbers_[1] : 0.0);
    }

    void add_normal(std::string_view text) {
        read_numbers("vn", text, 3);
        require_room(geometry_.normals.size());
        geometry_.normals.emplace_back(numbers_[0], numbers_[1], numbers_[2]);
    }

    void require_room(std::size_t count) const {
        if (count >= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
            fail("more than 2^31 vertices; split the file");
        }
    }

    void add_face(std::string_view text) {
        split_before_comment(text, words_);
        const std::size_t first = geometry_.corners.size();
        CornerForm form;
        for (const std::string_view word : words_) {
            ObjCorner corner;
            const CornerForm own = parse_corner(word, corner);
            if (geometry_.corners.size() == first) form = own;
            if (own != form) {
                fail("'" + excerpt(words_.front()) + "' and '" + excerpt(word) +
                     "' are written differently; all vertices of a face need the same parts");
            }
            geometry_.corners.push_back(corner);
        }
        const std::size_t count = geometry_.corners.size() - first;
        if (count < 3) {
            geometry_.corners.resize(first);
            if (geometry_.first_short_face == 0) {
                geometry_.first_short_face = line_;
                leave_out(geometry_.left_out, "faces of less than three vertices", "they have no area");
            }
            return;
        }
        geometry_.faces.push_back({first, static_cast<std::uint32_t>(count), material_});
    }

    /// v, v/t, v//n or v/t/n; parts may be empty but for the first.
    CornerForm parse_corner(std::string_view word, ObjCorner& corner) {
        const std::array<std::string_view, 3> parts = split_corner(word);
        corner.position = index(parts[0], geometry_.positions.size(), largest_position_);
        if (!parts[1].empty()) corner.uv = index(parts[1], geometry_.uvs.size(), largest_uv_);
        if (!parts[2].empty()) corner.normal = index(parts[2], geometry_.normals.size(), largest_normal_);
        return {static_cast<int>(std::count(word.begin(), word.end(), '/')), !parts[1].empty(), !parts[2].empty()};
    }

    std::array<std::string_view, 3> split_corner(std::string_view word) const {
        std::array<std::string_view, 3> parts;
        std::string_view rest = word;
        for (std::string_view& part : parts) {
            const std::size_t end = rest.find('/');
            part = rest.substr(0, end);
            if (end == std::string_view::npos) return parts;
            rest.remove_prefix(end + 1);
        }
        fail("'" + excerpt(word) + "' is not a face's vertex; write v, v/t, v//n or v/t/n");
    }

    std::int32_t index(std::string_view text, std::size_t count, LargestIndex& largest) const {
        std::int64_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool whole = error == std::errc{} && end == text.data() + text.size();
        const auto known = static_cast<std::int64_t>(count);
        constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
        if (!whole || value == 0 || value > most || -value > known) {
            fail("'" + excerpt(text) + "' is not the index of a " + largest.what + "; correct the face");
        }
        const auto result = static_cast<std::int32_t>(value > 0 ? value - 1 : known + value);
        if (result > largest.index) {
            largest.index = result;
            largest.line = line_;
        }
        return result;
    }

    void require_exists(const LargestIndex& largest, std::size_t count) const {
        if (largest.index < static_cast<std::int64_t>(count)) return;
        fail_at(path_, largest.line,
                std::string(largest.what) + " " + std::to_string(static_cast<std::int64_t>(largest.index) + 1) +
                    " does not exist: the file has " + std::to_string(count) + "; it is cut off or damaged");
    }

    void use_material(std::string_view name) {
        const auto [entry, is_new] = material_of_.try_emplace(std::string(name),
                                                              static_cast<std::int32_t>(geometry_.materials.size()));
        if (is_new) geometry_.materials.push_back({std::string(name), line_});
        material_ = entry->second;
    }

    /// Vertices without a color are white. Whole numbers of which one is above 1 are bytes: n / 255.
    void finish_colors() {
        std::vector<glm::vec3>& colors = geometry_.colors;
        if (colors.empty()) return;
        float largest = 0.0f;
        bool all_whole = true;
        for (const glm::vec3& color : colors) {
            for (int c = 0; c < 3; ++c) {
                largest = std::max(largest, color[c]);
                all_whole = all_whole && color[c] == std::floor(color[c]);
            }
        }
        if (all_whole && largest > 1.0f && largest <= 255.0f) {
            for (glm::vec3& color : colors) color /= 255.0f;
        }
        colors.resize(geometry_.positions.size(), glm::vec3(1.0f));
    }

    const std::filesystem::path& path_;
    ObjGeometry geometry_;
    std::size_t line_ = 0;
    std::vector<std::string_view> words_;
    std::vector<double> numbers_;
    LargestIndex largest_position_{"vertex"};
    LargestIndex largest_uv_{"uv"};
    LargestIndex largest_normal_{"normal"};
    std::map<std::string, std::int32_t> material_of_;
    std::int32_t material_ = -1;
    bool has_odd_position_ = false;
    std::set<std::string> unknown_;
};

}  // namespace

ObjGeometry parse_obj(const std::filesystem::path& path, std::string_view text) { return ObjParser(path, text).take(); }

}  // namespace render
