#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <lightcuts/piecewise/piecewise_constant.hpp>

#include "hourly_sky.hpp"
#include "node_sums.hpp"

namespace daylighting {

/// The sky cuts of sensors as rows of a sparse matrix, sorted by the sensors' normals, which share node sums.
class CutMatrix {
public:
    /// `read(i, out)`: makes `out` the sky cut of sensor i.
    CutMatrix(std::span<const Sensor> sensors,
              const std::function<void(std::size_t, lightcuts::PiecewiseConstant<float>&)>& read);

    /// The sensors of one normal.
    struct Group {
        glm::vec3 normal{0.0f};
        std::vector<std::uint32_t> sensors;
    };
    const std::vector<Group>& groups() const { return groups_; }
    std::span<const CutEntry> row(std::size_t sensor) const {
        return std::span(entries_).subspan(begins_[sensor], begins_[sensor + 1] - begins_[sensor]);
    }
    std::size_t size() const { return begins_.size() - 1; }
    std::size_t entries() const { return entries_.size(); }
    std::size_t memory_bytes() const { return entries_.size() * sizeof(CutEntry) + begins_.size() * 8; }

private:
    std::vector<Group> groups_;
    std::vector<std::size_t> begins_;
    std::vector<CutEntry> entries_;
};

/// Illuminances of sensors in lit hours, lux: those of a sensor one after the other.
struct Illuminances {
    std::size_t sensors = 0;
    std::size_t hours = 0;
    std::vector<float> lux;

    /// Keeps the first sensors only.
    void drop_beyond(std::size_t count) {
        sensors = count;
        lux.resize(count * hours);
    }
    std::span<float> of(std::size_t sensor) { return std::span(lux).subspan(sensor * hours, hours); }
    std::span<const float> of(std::size_t sensor) const { return std::span(lux).subspan(sensor * hours, hours); }
};

/// What all skies give to all sensors, without suns. `step`: called as 16 hours are done, from any thread.
/// threads: all of the calling arena. cost: of 16 hours, a pass over the tree each normal, and a cache line each entry
/// of the matrix.
Illuminances sky_light(const CutMatrix& cuts, const DirectionTree& directions, std::span<const LitHour> hours,
                       const Setting& setting, const std::function<void()>& step = {});

/// Adds to `lux` the sun of one hour, of which a sensor sees the share `seen`, and returns 1 if it shines there: of at
/// least 120 W/m^2, by `weather`, and more than half of it is seen; else 0.
double add_sun(const LitHour& hour, const glm::vec3& normal, float seen, const Weather& weather, float& lux);

/// Lit hours in the order of their suns' places: what the suns of a year ask of each sensor's sun cut in one pass.
class SunList {
public:
    explicit SunList(std::span<const LitHour> hours);

    /// Adds the suns' light to a sensor's illuminances, and returns how many hours the sun shone on it, as `add_sun`
    /// says. `sun`: the sensor's cut. cost: O(hours + pieces).
    double add(const lightcuts::PiecewiseConstant<float>& sun, const glm::vec3& normal, const Weather& weather,
               std::span<float> lux) const;

private:
    std::span<const LitHour> hours_;
    std::vector<std::uint32_t> order_;
};

}  // namespace daylighting
