#include "annual.hpp"

#include <algorithm>

namespace daylighting {

AnnualFigures annual_figures(const Weather& weather, std::span<const LitHour> hours, std::span<const float> lux,
                             const Occupancy& occupancy, double target, std::optional<double> sun_hours) {
    const auto is_used = [&](std::size_t hour) {
        const int ends = weather.hours[hour].hour;
        return ends > occupancy.from && ends <= occupancy.to;
    };
    std::size_t used = 0, used_and_lit = 0;
    for (std::size_t i = 0; i < weather.hours.size(); ++i) used += is_used(i) ? 1 : 0;
    AnnualFigures figures;
    figures.sun_hours = sun_hours;
    if (used == 0) return figures;
    for (std::size_t i = 0; i < hours.size(); ++i) {
        if (!is_used(hours[i].hour)) continue;
        ++used_and_lit;
        const auto value = static_cast<double>(lux[i]);
        figures.mean += value;
        figures.autonomy += value >= target ? 1.0 : 0.0;
        figures.useful_to_2000 += value >= 100.0 && value <= 2000.0 ? 1.0 : 0.0;
        figures.useful_to_3000 += value >= 100.0 && value <= 3000.0 ? 1.0 : 0.0;
        figures.too_dark += value < 100.0 ? 1.0 : 0.0;
        figures.too_bright += value > 3000.0 ? 1.0 : 0.0;
    }
    const auto n = static_cast<double>(used), dark = static_cast<double>(used - used_and_lit);
    figures.too_dark += dark;
    if (!(target > 0.0)) figures.autonomy += dark;
    for (double* share : {&figures.mean, &figures.autonomy, &figures.useful_to_2000, &figures.useful_to_3000,
                          &figures.too_dark, &figures.too_bright}) {
        *share /= n;
    }
    return figures;
}

}  // namespace daylighting
