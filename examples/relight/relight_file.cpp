#include "relight_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>
#include <string_view>
#include <vector>

#include <lightcuts/core/invalid_input.hpp>
#include <nlohmann/json.hpp>
#include <render/fingerprint.hpp>
#include <render/io/content_hash.hpp>
#include <render/io/escape.hpp>

#include "visibility_cuts.hpp"

namespace relight {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kind = "lightcuts-relight ";
constexpr std::string_view kind_alone = "lightcuts-relight 1 ", kind_with_bounce = "lightcuts-relight 2 ";
constexpr std::size_t longest_header = 1 << 16;

std::string hexadecimal(std::uint64_t value) {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
    return text;
}

/// Of a header without its own.
std::string checksum(const Json& header) { return hexadecimal(render::ContentHash().add(header.dump()).value()); }

struct Header {
    Preparation preparation;
    std::size_t tree_bytes = 0;
    std::size_t cut_bytes = 0;
    float patch_area = 0.0f;
    std::size_t patch_bytes = 0;
    std::size_t bounce_bytes = 0;

    std::size_t bytes() const { return tree_bytes + cut_bytes + patch_bytes + bounce_bytes; }
};

/// throws: nlohmann's exceptions, or false for a header that has been changed.
bool parse(std::string_view line, bool has_bounce, Header& header) {
    Json json = Json::parse(line);
    const std::string check = json.at("check");
    json.erase("check");
    if (check != checksum(json)) return false;
    Preparation& p = header.preparation;
    p.scene = json.at("scene");
    p.fingerprint = std::stoull(json.at("fingerprint").get<std::string>(), nullptr, 16);
    p.longest_edge = json.at("longest_edge");
    p.sides = json.at("sides") == "front" ? Sides::front : Sides::both;
    p.sites = json.at("sites");
    header.tree_bytes = json.at("tree_bytes");
    header.cut_bytes = json.at("cut_bytes");
    if (has_bounce) {
        header.patch_area = json.at("patch_area");
        header.patch_bytes = json.at("patch_bytes");
        header.bounce_bytes = json.at("bounce_bytes");
        if (!(std::isfinite(header.patch_area) && header.patch_area > 0.0f)) return false;
    }
    return std::isfinite(p.longest_edge) && p.longest_edge >= 0.0;
}

/// Calls `action`; what it refuses then names the file.
template <class Action>
auto naming(const std::string& name, Action&& action) {
    try {
        return action();
    } catch (const lightcuts::invalid_input& problem) { throw lightcuts::invalid_input(name + ": " + problem.what()); }
}

}  // namespace

std::vector<char> relight_file(const Preparation& preparation, const Directions& directions,
                               std::span<const std::byte> cuts, const StoredBounce* bounce) {
    const std::vector<std::byte> tree = to_bytes(directions);
    const std::vector<std::byte> patches = bounce ? to_bytes(bounce->patches) : std::vector<std::byte>();
    const std::span<const std::byte> bounce_cuts = bounce ? bounce->cuts : std::span<const std::byte>();
    Json json;
    json["scene"] = render::as_utf8(preparation.scene);
    json["fingerprint"] = hexadecimal(preparation.fingerprint);
    json["longest_edge"] = preparation.longest_edge;
    json["sides"] = preparation.sides == Sides::front ? "front" : "both";
    json["sites"] = preparation.sites;
    json["directions"] = directions.size();
    json["tree_bytes"] = tree.size();
    json["cut_bytes"] = cuts.size();
    if (bounce) {
        json["patches"] = bounce->patches.size();
        json["patch_area"] = bounce->patches.area;
        json["patch_bytes"] = patches.size();
        json["bounce_bytes"] = bounce_cuts.size();
    }
    json["check"] = checksum(json);
    const std::string header = std::string(bounce ? kind_with_bounce : kind_alone) + json.dump() + "\n";
    std::vector<char> file(header.begin(), header.end());
    for (const std::span<const std::byte> part :
         {std::span<const std::byte>(tree), cuts, std::span<const std::byte>(patches), bounce_cuts}) {
        const auto* bytes = reinterpret_cast<const char*>(part.data());
        file.insert(file.end(), bytes, bytes + part.size());
    }
    return file;
}

RelightFile::RelightFile(const std::filesystem::path& path) : name_(path.string()), file_(path) {
    const std::span<const std::byte> bytes = file_.bytes();
    const std::string_view start(reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), longest_header));
    const auto refuse = [&](const std::string& what) -> void { throw lightcuts::invalid_input(name_ + ": " + what); };
    if (!start.starts_with(kind)) { refuse("is no file of visibility cuts; make one by lightcuts-relight prepare"); }
    const bool has_bounce = start.starts_with(kind_with_bounce);
    if (!has_bounce && !start.starts_with(kind_alone)) refuse("is of another version; prepare it anew");
    const std::size_t end = start.find('\n');
    if (end == std::string_view::npos) refuse("is cut short, or damaged; prepare it anew");
    Header header;
    bool is_whole = false;
    try {
        is_whole = parse(start.substr(kind_alone.size(), end - kind_alone.size()), has_bounce, header);
    } catch (const std::exception&) {
        is_whole = false;  // not what this program wrote
    }
    if (!is_whole) refuse("its first line is damaged; prepare it anew");
    if (std::max({header.tree_bytes, header.cut_bytes, header.patch_bytes, header.bounce_bytes}) > bytes.size()) {
        refuse("is cut short; prepare it anew");
    }
    const std::size_t expected = end + 1 + header.bytes();
    if (bytes.size() != expected) {
        refuse(bytes.size() < expected
                   ? "is cut short: " + std::to_string(expected - bytes.size()) + " bytes are missing; prepare it anew"
                   : "has " + std::to_string(bytes.size() - expected) + " bytes too many; prepare it anew");
    }
    preparation_ = header.preparation;
    naming(name_, [&] {
        std::size_t begin = end + 1;
        const auto next = [&](std::size_t size) {
            begin += size;
            return bytes.subspan(begin - size, size);
        };
        directions_ = read_directions(next(header.tree_bytes));
        cuts_.emplace(next(header.cut_bytes), directions_.tree);
        if (!has_bounce) return;
        patches_ = read_patches(next(header.patch_bytes), header.patch_area);
        bounce_cuts_.emplace(next(header.bounce_bytes), patches_.tree);
    });
    for (const auto* cuts : {&cuts_, &bounce_cuts_}) {
        if (!*cuts || (*cuts)->size() == preparation_.sites) continue;
        refuse("has " + std::to_string((*cuts)->size()) + " cuts for " + std::to_string(preparation_.sites) +
               " places of the mesh; prepare it anew");
    }
}

void RelightFile::require_scene(const render::Scene& scene) const {
    if (render::occlusion_hash(scene) == preparation_.fingerprint) return;
    throw lightcuts::invalid_input(name_ + ": was prepared of another mesh, " + preparation_.scene + ", than " +
                                   scene.name + " is now; prepare it anew");
}

void RelightFile::read(std::size_t site, lightcuts::PiecewiseConstant<float>& cut) const {
    naming(name_, [&] { cuts_->read(site, cut); });
}

void RelightFile::read_bounce(std::size_t site, lightcuts::PiecewiseConstant<float>& cut) const {
    naming(name_, [&] { bounce_cuts_->read(site, cut); });
    for (float& value : cut.values()) value = read_solid_angle(value);
}

}  // namespace relight
