#include "visibility_file.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <utility>

#include <lightcuts/core/invalid_input.hpp>
#include <lightcuts/core/vector.hpp>
#include <lightcuts/piecewise/tree_file.hpp>
#include <render/io/content_hash.hpp>

namespace daylighting {
namespace {

constexpr std::string_view magic = "lightcuts-daylight: what sensors see, format 1\n";
constexpr std::string_view magic_of_any_format = magic.substr(0, magic.size() - 2);
constexpr std::uint64_t byte_order = 0x0102030405060708u;
/// Of trees whose nodes have a direction; those that are no leaf have none.
constexpr std::uint64_t direction_tag = 0x6461796c69676874u;

/// After `magic`.
struct Header {
    std::uint64_t byte_order = daylighting::byte_order;
    std::array<std::uint64_t, 6> sizes{};  ///< of the tree, sensors, points, links, cuts of skies and of suns
    std::uint64_t scene = 0;
    std::uint64_t check = 0;  ///< of all that is above, and of sensors, points and links
};

struct SensorHeader {
    std::uint32_t columns, rows, up, unused;
};

/// Without padding.
struct SensorRecord {
    double position[3];
    float normal[3];
    std::uint32_t unused;
};
static_assert(sizeof(SensorRecord) == 40);

template <class T>
void append(std::vector<std::byte>& to, const T* data, std::size_t count) {
    if (count == 0) return;
    const std::size_t begin = to.size();
    to.resize(begin + count * sizeof(T));
    std::memcpy(to.data() + begin, data, count * sizeof(T));
}

std::vector<std::byte> bytes_of(const SensorSet& set) {
    std::vector<std::byte> bytes;
    const SensorHeader header{set.columns, set.rows, static_cast<std::uint32_t>(set.up), 0};
    append(bytes, &header, 1);
    for (const Sensor& s : set.sensors) {
        const SensorRecord record{{s.position.x, s.position.y, s.position.z}, {s.normal.x, s.normal.y, s.normal.z}, 0};
        append(bytes, &record, 1);
    }
    return bytes;
}

std::uint64_t check_of(const Header& header, std::span<const std::byte> sensors, std::span<const std::byte> points,
                       std::span<const std::byte> links) {
    render::ContentHash hash;
    for (const std::uint64_t size : header.sizes) hash.add(size);
    hash.add(header.scene);
    for (const auto part : {sensors, points, links}) hash.add_bytes(part.data(), part.size());
    return hash.value();
}

[[noreturn]] void refuse(const std::string& problem) { throw lightcuts::invalid_input(problem); }

SensorSet sensors_of(std::span<const std::byte> bytes) {
    SensorHeader header{};
    if (bytes.size() < sizeof header || (bytes.size() - sizeof header) % sizeof(SensorRecord) != 0) {
        refuse("has no list of sensors");
    }
    std::memcpy(&header, bytes.data(), sizeof header);
    SensorSet set;
    set.columns = header.columns;
    set.rows = header.rows;
    set.up = header.up == 0 ? UpAxis::y : UpAxis::z;
    for (std::size_t at = sizeof header; at < bytes.size(); at += sizeof(SensorRecord)) {
        SensorRecord r{};
        std::memcpy(&r, bytes.data() + at, sizeof r);
        set.sensors.push_back({{r.position[0], r.position[1], r.position[2]}, {r.normal[0], r.normal[1], r.normal[2]}});
    }
    if (header.up > 1 || (header.columns != 0 && std::uint64_t{header.columns} * header.rows != set.sensors.size())) {
        refuse("has a list of sensors that is damaged");
    }
    return set;
}

/// The ends of each sensor's links, then the links.
std::vector<std::byte> bytes_of(const Bounce& bounce) {
    std::vector<std::byte> bytes;
    for (const std::size_t end : bounce.ends) {
        const std::uint64_t number = end;
        append(bytes, &number, 1);
    }
    append(bytes, bounce.links.data(), bounce.links.size());
    return bytes;
}

void read_links(std::span<const std::byte> bytes, std::size_t sensors, Bounce& bounce) {
    if (bytes.empty() && bounce.points.empty()) return;
    const std::size_t index = sensors * sizeof(std::uint64_t);
    if (bytes.size() < index || (bytes.size() - index) % sizeof(Bounce::Link) != 0)
        refuse("has links that are damaged");
    bounce.links.resize((bytes.size() - index) / sizeof(Bounce::Link));
    for (std::size_t i = 0; i < sensors; ++i) {
        std::uint64_t end = 0;
        std::memcpy(&end, bytes.data() + i * sizeof end, sizeof end);
        if (end > bounce.links.size() || (i > 0 && end < bounce.ends.back())) refuse("has links that are damaged");
        bounce.ends.push_back(static_cast<std::size_t>(end));
    }
    for (std::size_t i = 0; i < bounce.links.size(); ++i) {
        std::memcpy(&bounce.links[i], bytes.data() + index + i * sizeof(Bounce::Link), sizeof(Bounce::Link));
        if (bounce.links[i].point >= bounce.points.size()) refuse("has links that are damaged");
    }
}

DirectionTree directions_of(std::span<const std::byte> bytes) {
    lightcuts::SavedTree<glm::vec3> saved = lightcuts::read_tree<glm::vec3>(bytes, direction_tag);
    DirectionTree result;
    result.tree = std::move(saved.tree);
    if (result.tree.item_count() < 2 || !result.tree.is_binary()) refuse("has no tree of directions");
    for (std::uint32_t n = 0; n < result.tree.size(); ++n) {
        if (!result.tree.is_leaf(n)) continue;
        const bool in_order = result.tree.item(n) == result.directions.size();
        if (!in_order || !lightcuts::is_finite(saved.summaries[n])) refuse("has directions that are damaged");
        result.directions.push_back(saved.summaries[n]);
    }
    return result;
}

}  // namespace

std::vector<std::byte> visibility_file(const DirectionTree& directions, const SensorSet& sensors, const Bounce& bounce,
                                       const lightcuts::CutFileWriter& sky, const lightcuts::CutFileWriter& sun,
                                       std::uint64_t scene) {
    std::vector<glm::vec3> of_nodes(directions.tree.size(), glm::vec3(0.0f));
    for (std::uint32_t n = 0; n < directions.tree.size(); ++n) {
        if (directions.tree.is_leaf(n)) of_nodes[n] = directions.directions[directions.tree.item(n)];
    }
    SensorSet points;
    points.sensors = bounce.points;
    const std::array<std::vector<std::byte>, 6> parts = {
        lightcuts::tree_file(directions.tree, std::span<const glm::vec3>(of_nodes), direction_tag),
        bytes_of(sensors),
        bytes_of(points),
        bytes_of(bounce),
        sky.bytes(),
        sun.bytes()};
    Header header;
    header.scene = scene;
    for (std::size_t i = 0; i < parts.size(); ++i) header.sizes[i] = parts[i].size();
    header.check = check_of(header, parts[1], parts[2], parts[3]);
    std::vector<std::byte> file;
    append(file, magic.data(), magic.size());
    append(file, &header, 1);
    for (const std::vector<std::byte>& part : parts) append(file, part.data(), part.size());
    return file;
}

VisibilityFile::VisibilityFile(const std::filesystem::path& path) : path_(path), file_(path) {
    try {
        const std::span<const std::byte> bytes = file_.bytes();
        const std::string_view start(reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), magic.size()));
        if (!start.starts_with(magic_of_any_format)) refuse("is no file of lightcuts-daylight trace");
        if (start != magic) refuse("is of another version of this program; trace it anew");
        Header header;
        if (bytes.size() < magic.size() + sizeof header) refuse("is cut short; trace it anew");
        std::memcpy(&header, bytes.data() + magic.size(), sizeof header);
        if (header.byte_order != byte_order) refuse("is of a machine of another byte order; trace it anew");
        std::array<std::span<const std::byte>, 6> parts;
        std::span<const std::byte> rest = bytes.subspan(magic.size() + sizeof header);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            if (header.sizes[i] > rest.size()) refuse("is cut short, or damaged; trace it anew");
            parts[i] = rest.first(static_cast<std::size_t>(header.sizes[i]));
            rest = rest.subspan(parts[i].size());
        }
        if (!rest.empty()) refuse("has bytes after its end; trace it anew");
        if (check_of(header, parts[1], parts[2], parts[3]) != header.check) refuse("is damaged; trace it anew");
        directions_ = directions_of(parts[0]);
        sensors_ = sensors_of(parts[1]);
        if (sensors_.sensors.empty()) refuse("has no sensors");
        scene_ = header.scene;
        bounce_.points = sensors_of(parts[2]).sensors;
        read_links(parts[3], sensors_.sensors.size(), bounce_);
        sky_.emplace(parts[4], directions_.tree);
        sun_.emplace(parts[5], directions_.tree);
        const std::size_t cuts = sensors_.sensors.size() + bounce_.points.size();
        if (sky_->size() != cuts || sun_->size() != cuts) refuse("has not two cuts each sensor");
    } catch (const lightcuts::invalid_input& e) { throw lightcuts::invalid_input(path.string() + ": " + e.what()); }
}

std::vector<Sensor> VisibilityFile::all() const {
    std::vector<Sensor> result = sensors_.sensors;
    result.insert(result.end(), bounce_.points.begin(), bounce_.points.end());
    return result;
}

void VisibilityFile::read(const lightcuts::CutFile& cuts, std::size_t sensor,
                          lightcuts::PiecewiseConstant<float>& out) const {
    try {
        cuts.read(sensor, out);
    } catch (const lightcuts::invalid_input& e) { throw lightcuts::invalid_input(path_.string() + ": " + e.what()); }
}

}  // namespace daylighting
