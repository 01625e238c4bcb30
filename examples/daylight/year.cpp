#include "year.hpp"

#include <algorithm>
#include <array>
#include <map>

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <glm/geometric.hpp>

namespace daylighting {
namespace {

/// From which on the World Meteorological Organization says that the sun shines.
constexpr double least_sunshine = 120.0;  // W/m^2

}  // namespace

CutMatrix::CutMatrix(std::span<const Sensor> sensors,
                     const std::function<void(std::size_t, lightcuts::PiecewiseConstant<float>&)>& read) {
    std::map<std::array<float, 3>, std::size_t> known;
    lightcuts::PiecewiseConstant<float> cut;
    begins_.push_back(0);
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        const glm::vec3& n = sensors[i].normal;
        const auto [at, is_new] = known.try_emplace({n.x, n.y, n.z}, groups_.size());
        if (is_new) groups_.push_back({n, {}});
        groups_[at->second].sensors.push_back(static_cast<std::uint32_t>(i));
        read(i, cut);
        for (std::size_t k = 0; k < cut.size(); ++k) {
            if (cut.values()[k] != 0.0f) entries_.push_back({cut.pieces()[k].node(), cut.values()[k]});
        }
        begins_.push_back(entries_.size());
    }
}

Illuminances sky_light(const CutMatrix& cuts, const DirectionTree& directions, std::span<const LitHour> hours,
                       const Setting& setting, const std::function<void()>& step) {
    Illuminances result{cuts.size(), hours.size(), std::vector<float>(cuts.size() * hours.size(), 0.0f)};
    struct Workspace {
        SkyBlock block;
        std::vector<float> cosines;
        std::vector<HourValues> sums;
    };
    tbb::enumerable_thread_specific<Workspace> workspaces([&] {
        return Workspace{SkyBlock(directions, setting), std::vector<float>(directions.size()), {}};
    });
    const std::size_t blocks = (hours.size() + block_hours - 1) / block_hours;
    tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
        Workspace& work = workspaces.local();
        const std::size_t first = b * block_hours, count = std::min(block_hours, hours.size() - first);
        work.block.fill(hours.subspan(first, count));
        for (const CutMatrix::Group& group : cuts.groups()) {
            for (std::size_t i = 0; i < directions.size(); ++i) {
                work.cosines[i] = std::max(0.0f, glm::dot(group.normal, directions.directions[i]));
            }
            node_sums(directions.tree, work.cosines, work.block.light(), work.sums);
            for (const std::uint32_t sensor : group.sensors) {
                const HourValues lux = product(cuts.row(sensor), work.sums);
                std::copy_n(lux.begin(), count, result.of(sensor).begin() + static_cast<std::ptrdiff_t>(first));
            }
        }
        if (step) step();
    });
    return result;
}

double add_sun(const LitHour& hour, const glm::vec3& normal, float seen, const Weather& weather, float& lux) {
    const float cosine = glm::dot(normal, hour.towards_sun);
    if (!(cosine > 0.0f)) return 0.0;
    lux += seen * cosine * static_cast<float>(hour.direct_illuminance);
    return seen > 0.5f && weather.hours[hour.hour].direct_normal >= least_sunshine ? 1.0 : 0.0;
}

SunList::SunList(std::span<const LitHour> hours) : hours_(hours) {
    for (std::size_t i = 0; i < hours.size(); ++i) {
        if (hours[i].has_sun()) order_.push_back(static_cast<std::uint32_t>(i));
    }
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return hours[a].sun_place < hours[b].sun_place; });
}

double SunList::add(const lightcuts::PiecewiseConstant<float>& sun, const glm::vec3& normal, const Weather& weather,
                    std::span<float> lux) const {
    std::size_t piece = 0;
    double shining = 0.0;
    for (const std::uint32_t i : order_) {
        while (sun.pieces()[piece].leaf_end() <= hours_[i].sun_place) ++piece;
        shining += add_sun(hours_[i], normal, sun.values()[piece], weather, lux[i]);
    }
    return shining;
}

}  // namespace daylighting
