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

namespace relight {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kind = "lightcuts-relight 1";
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
};

/// throws: nlohmann's exceptions, or false for a header that has been changed.
bool parse(std::string_view line, Header& header) {
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
                               std::span<const std::byte> cuts) {
    const std::vector<std::byte> tree = to_bytes(directions);
    Json json;
    json["scene"] = render::as_utf8(preparation.scene);
    json["fingerprint"] = hexadecimal(preparation.fingerprint);
    json["longest_edge"] = preparation.longest_edge;
    json["sides"] = preparation.sides == Sides::front ? "front" : "both";
    json["sites"] = preparation.sites;
    json["directions"] = directions.size();
    json["tree_bytes"] = tree.size();
    json["cut_bytes"] = cuts.size();
    json["check"] = checksum(json);
    const std::string header = std::string(kind) + " " + json.dump() + "\n";
    std::vector<char> file(header.begin(), header.end());
    for (const std::span<const std::byte> part : {std::span<const std::byte>(tree), cuts}) {
        const auto* bytes = reinterpret_cast<const char*>(part.data());
        file.insert(file.end(), bytes, bytes + part.size());
    }
    return file;
}

RelightFile::RelightFile(const std::filesystem::path& path) : name_(path.string()), file_(path) {
    const std::span<const std::byte> bytes = file_.bytes();
    const std::string_view start(reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), longest_header));
    const auto refuse = [&](const std::string& what) -> void { throw lightcuts::invalid_input(name_ + ": " + what); };
    if (!start.starts_with(kind.substr(0, kind.size() - 1))) {
        refuse("is no file of visibility cuts; make one by lightcuts-relight prepare");
    }
    if (!start.starts_with(std::string(kind) + " ")) refuse("is of another version; prepare it anew");
    const std::size_t end = start.find('\n');
    if (end == std::string_view::npos) refuse("is cut short, or damaged; prepare it anew");
    Header header;
    bool is_whole = false;
    try {
        is_whole = parse(start.substr(kind.size(), end - kind.size()), header);
    } catch (const std::exception&) {
        is_whole = false;  // not what this program wrote
    }
    if (!is_whole) refuse("its first line is damaged; prepare it anew");
    if (std::max(header.tree_bytes, header.cut_bytes) > bytes.size()) refuse("is cut short; prepare it anew");
    const std::size_t expected = end + 1 + header.tree_bytes + header.cut_bytes;
    if (bytes.size() != expected) {
        refuse(bytes.size() < expected
                   ? "is cut short: " + std::to_string(expected - bytes.size()) + " bytes are missing; prepare it anew"
                   : "has " + std::to_string(bytes.size() - expected) + " bytes too many; prepare it anew");
    }
    preparation_ = header.preparation;
    naming(name_, [&] {
        directions_ = read_directions(bytes.subspan(end + 1, header.tree_bytes));
        cuts_.emplace(bytes.subspan(end + 1 + header.tree_bytes), directions_.tree);
    });
    if (cuts_->size() != preparation_.sites) {
        refuse("has " + std::to_string(cuts_->size()) + " cuts for " + std::to_string(preparation_.sites) +
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

}  // namespace relight
