#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <lightcuts/piecewise/cut_file.hpp>
#include <lightcuts/piecewise/mapped_file.hpp>

#include "bounce.hpp"
#include "direction_tree.hpp"
#include "sensors.hpp"

namespace daylighting {

/// How the cuts of a file are encoded.
inline constexpr lightcuts::CutEncoding cut_encoding{.bits = lightcuts::ValueBits::eight, .deviations = false};

/// The bytes of a file of what sensors see: the tree of directions, the sensors, the points that reflect light to them,
/// if any, and of each sensor and then each point its two cuts. `sky` and `sun` have these, of the tree of
/// `directions`.
std::vector<std::byte> visibility_file(const DirectionTree& directions, const SensorSet& sensors, const Bounce& bounce,
                                       const lightcuts::CutFileWriter& sky, const lightcuts::CutFileWriter& sun,
                                       std::uint64_t scene = 0);

/// Such a file, mapped: cuts are read as they are asked for. threads: by many at once.
class VisibilityFile {
public:
    /// throws: invalid_input, one line naming the file, if it is no such file, cut short or damaged; cuts are checked
    /// as they are read.
    explicit VisibilityFile(const std::filesystem::path& path);
    VisibilityFile(const VisibilityFile&) = delete;
    VisibilityFile& operator=(const VisibilityFile&) = delete;

    const DirectionTree& directions() const { return directions_; }
    const SensorSet& sensors() const { return sensors_; }
    /// Without links if no light bounces.
    const Bounce& bounce() const { return bounce_; }
    std::uint64_t scene() const { return scene_; }
    /// The sensors and then the points.
    std::vector<Sensor> all() const;

    /// Of one of `all()`. throws: invalid_input naming the file and the cut if it is damaged.
    void read_sky(std::size_t sensor, lightcuts::PiecewiseConstant<float>& out) const { read(*sky_, sensor, out); }
    void read_sun(std::size_t sensor, lightcuts::PiecewiseConstant<float>& out) const { read(*sun_, sensor, out); }

private:
    void read(const lightcuts::CutFile& cuts, std::size_t sensor, lightcuts::PiecewiseConstant<float>& out) const;

    std::filesystem::path path_;
    lightcuts::MappedFile file_;
    DirectionTree directions_;
    SensorSet sensors_;
    Bounce bounce_;
    std::uint64_t scene_ = 0;
    std::optional<lightcuts::CutFile> sky_, sun_;  ///< refer to the file and to the tree
};

}  // namespace daylighting
