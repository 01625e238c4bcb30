#include "check_obj.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "text_file.hpp"

namespace render {
namespace {

using Words = std::vector<std::string_view>;

/// One line of a file, for messages.
struct Place {
    const std::filesystem::path& path;
    std::size_t line;

    [[noreturn]] void fail(const std::string& text) const { fail_at(path, line, text); }
};

void check_numbers(const Place& place, const Words& words, std::size_t least, bool may_be_negative) {
    if (words.size() < least + 1) {
        place.fail("'" + std::string(words[0]) + "' needs " + std::to_string(least) +
                   " numbers; the line is broken or cut off");
    }
    for (std::size_t i = 1; i <= least; ++i) {
        const auto value = parse_number(words[i]);
        if (!value || !std::isfinite(static_cast<float>(*value)) || (!may_be_negative && *value < 0.0)) {
            place.fail("'" + std::string(words[i]) + "' is not a finite " + (may_be_negative ? "" : "positive ") +
                       "number; correct it");
        }
    }
}

/// How many vertices, uvs and normals there are, in the order in which a face names them, and the largest index
/// that a face has used.
struct IndexRange {
    const char* what;
    long count = 0;
    long largest = 0;
    std::size_t largest_line = 0;
};

class ObjChecker {
public:
    ObjChecker(const std::filesystem::path& path, std::string_view text) : path_(path) {
        for_each_line(text, [&](std::size_t line, std::string_view content) {
            const Words words = split_words(content);
            if (!words.empty()) check_line({path_, line}, words);
        });
        for (const IndexRange& range : ranges_) {
            if (range.largest > range.count) {
                fail_at(path_, range.largest_line,
                        std::string(range.what) + " " + std::to_string(range.largest) +
                            " does not exist: the file has " + std::to_string(range.count) +
                            "; it is cut off or damaged");
            }
        }
    }

    MaterialUses uses() const { return has_library_ ? uses_ : MaterialUses(); }

private:
    void check_line(const Place& place, const Words& words) {
        if (words[0] == "v") {
            check_numbers(place, words, 3, true);
            ++ranges_[0].count;
        } else if (words[0] == "vt") {
            check_numbers(place, words, 2, true);
            ++ranges_[1].count;
        } else if (words[0] == "vn") {
            check_numbers(place, words, 3, true);
            ++ranges_[2].count;
        } else if (words[0] == "f") {
            check_face(place, words);
        } else if (words[0] == "mtllib") {
            check_library(place, words);
        } else if (words[0] == "usemtl" && words.size() > 1) {
            uses_.try_emplace(std::string(words[1]), place.line);
        }
    }

    void check_face(const Place& place, const Words& words) {
        if (words.size() < 4) place.fail("a face needs at least 3 vertices; the line is broken or cut off");
        for (std::size_t i = 1; i < words.size(); ++i) check_corner(place, words[i]);
    }

    /// v, v/t, v//n or v/t/n
    void check_corner(const Place& place, std::string_view corner) {
        std::string_view rest = corner;
        for (std::size_t part = 0; part < ranges_.size(); ++part) {
            const std::size_t end = rest.find('/');
            const std::string_view number = rest.substr(0, end);
            if (!number.empty() || part == 0) check_index(place, number, ranges_[part]);
            if (end == std::string_view::npos) return;
            rest.remove_prefix(end + 1);
        }
        place.fail("'" + std::string(corner) + "' is not a face's vertex; write v, v/t, v//n or v/t/n");
    }

    static void check_index(const Place& place, std::string_view number, IndexRange& range) {
        long index = 0;
        const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), index);
        if (error != std::errc{} || end != number.data() + number.size() || index == 0 || -index > range.count) {
            place.fail("'" + std::string(number) + "' is not the index of a " + range.what + "; correct the face");
        }
        if (index > range.largest) {
            range.largest = index;
            range.largest_line = place.line;
        }
    }

    void check_library(const Place& place, const Words& words) {
        has_library_ = true;
        for (std::size_t i = 1; i < words.size(); ++i) {
            const std::filesystem::path library = path_.parent_path() / words[i];
            if (std::filesystem::exists(library)) return check_materials(library);
        }
        place.fail("no material library of that name; put it beside the OBJ file or remove the line");
    }

    static void check_materials(const std::filesystem::path& library) {
        const std::string text = read_file(library);
        for_each_line(text, [&](std::size_t line, std::string_view content) {
            const Words words = split_words(content);
            if (words.empty()) return;
            const std::string_view key = words[0];
            const Place place{library, line};
            if (key == "Kd" || key == "Ks" || key == "Ke" || key == "Tf") check_numbers(place, words, 3, false);
            if (key == "Ns" || key == "Ni" || key == "d" || key == "Tr") check_numbers(place, words, 1, false);
        });
    }

    const std::filesystem::path& path_;
    std::array<IndexRange, 3> ranges_{{{"vertex"}, {"uv"}, {"normal"}}};
    MaterialUses uses_;
    bool has_library_ = false;
};

}  // namespace

MaterialUses check_obj(const std::filesystem::path& path, std::string_view text) {
    return ObjChecker(path, text).uses();
}

}  // namespace render
