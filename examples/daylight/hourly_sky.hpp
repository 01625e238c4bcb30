#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "direction_tree.hpp"
#include "patch_light.hpp"
#include "sensors.hpp"
#include "sky_matrix.hpp"
#include "sky_shape.hpp"
#include "weather.hpp"

namespace daylighting {

/// How a scene lies under the sky.
struct Setting {
    UpAxis up = UpAxis::y;
    double turned = 0.0;         ///< degrees by which its north is turned from true north towards the east
    double ground_albedo = 0.2;  ///< share of the light that ground reflects, which lies below the horizon everywhere
};

/// An hour with light.
struct LitHour {
    std::size_t hour = 0;              ///< in the weather's list
    glm::dvec3 sun{0.0, 0.0, 1.0};     ///< unit, towards it: east, north, up
    double direct_illuminance = 0.0;   ///< of the sun on a plane that faces it, lux; 0 if it is below the horizon
    double diffuse_illuminance = 0.0;  ///< of the sky on level ground, lux
    SkyShape shape;                    ///< of the sky
    std::span<const float> patches{};  ///< if there are any, they are the sky in place of `shape`, see SkyMatrix
    glm::vec3 towards_sun{0.0f, 1.0f, 0.0f};  ///< in the scene's axes
    std::uint32_t sun_place = 0;              ///< of the direction nearest to the sun's

    bool has_sun() const { return direct_illuminance > 0.0; }
};

/// The hours of `weather` that have any light, in their order. Skies have the shape of Perez' all-weather model, or, if
/// `cie_type` is given, all that of this standard sky, see `cie_sky`; illuminances are those of Perez et al. for the
/// weather's irradiances either way. throws: as `cie_sky`. cost: a pass over the directions an hour
std::vector<LitHour> lit_hours(const Weather& weather, const DirectionTree& directions, const Setting& setting,
                               std::optional<int> cie_type = {});

/// The same with the skies and the ground of a matrix; from `weather` come suns alone. Refers to `skies`.
/// pre: as many hours in both.
std::vector<LitHour> lit_hours(const SkyMatrix& skies, const Weather& weather, const DirectionTree& directions,
                               const Setting& setting);

/// Hours that are handled at once.
inline constexpr std::size_t block_hours = 16;
using HourValues = std::array<float, block_hours>;

/// The light of up to 16 skies from each direction: luminance x solid angle, lux on a plane that faces it. Suns are not
/// in it. What comes from all directions above the horizon has on level ground exactly the hour's diffuse illuminance,
/// but for rounding. The ground is that of patches, or reflects the setting's share of sun and sky.
class SkyBlock {
public:
    /// Refers to `directions`.
    SkyBlock(const DirectionTree& directions, const Setting& setting);

    /// Makes it that of these hours; 0 for those that are missing to 16. pre: patches of all are of one division.
    /// cost: two exponentials a direction and hour; of patches one multiplication.
    void fill(std::span<const LitHour> hours);

    /// Of each direction, in the order of places.
    const std::vector<HourValues>& light() const { return light_; }

private:
    const DirectionTree& directions_;
    Setting setting_;
    std::vector<glm::dvec3> compass_;  ///< the directions: east, north, up
    std::vector<HourValues> light_;
    std::vector<double> luminances_;  ///< of one hour, up to a factor
    std::optional<PatchLight> patch_light_;
};

}  // namespace daylighting
