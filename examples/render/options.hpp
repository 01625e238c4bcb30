#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <glm/vec3.hpp>
#include <lightcuts/cut/clamp.hpp>
#include <lightcuts/source/sun_sky.hpp>

#include "shutter.hpp"

namespace render {

/// A command line that cannot be obeyed; `what()` is one line. Exit status 2.
class usage_error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The renderer's command line with its defaults.
struct Options {
    enum class Action { render, help, version, list_scenes };

    Action action = Action::render;
    std::string help;  ///< the text to print when the action is `help`

    std::string scene = "builtin:hall";  ///< a file, or builtin:NAME
    std::filesystem::path output = "render.exr";
    int width = 640;
    int height = 480;
    int spp = 1;

    std::string camera;             ///< name of one of the scene's cameras; empty: its first
    std::optional<glm::dvec3> eye;  ///< with `target`: a camera of the user's
    std::optional<glm::dvec3> target;
    std::optional<glm::vec3> up;
    std::optional<float> fov;  ///< vertical, degrees

    Shutter shutter;

    std::string method = "lightcuts";        ///< one of those that `--help` lists
    float error_ratio = 0.02f;               ///< a cluster is refined while its bound exceeds this share of the total
    std::uint32_t max_cut = 1000;            ///< 0: unlimited
    std::uint32_t representatives = 1;       ///< per node of a tree, 1 to 32
    std::optional<float> adaptation = 0.0f;  ///< radiance the eye is adapted to; empty: measured (`auto`)
    bool learn_visibility = false;           ///< cuts refine what some points of the picture see more of
    std::uint32_t samples = 64;              ///< of the sampling methods
    std::uint32_t candidates = 32;           ///< for each sample, of the methods that resample
    float ward_threshold = 0.1f;
    float splitting_threshold = 0.1f;
    std::string builder = "binned";          ///< binned, agglomerate or longest-axis
    std::string visibility_bounds = "auto";  ///< auto, on or off: clusters proved to be hidden
    std::string pair_sides = "bounds";       ///< bounds or sizes, see lightcuts::SideRule

    std::filesystem::path lights;              ///< CSV with more lights; empty: none
    std::uint32_t area_points = 64;            ///< lights per emissive surface or sphere, at most; 0: none
    std::optional<std::uint32_t> area_lights;  ///< about the most on all emissive surfaces; 0: any number
    std::filesystem::path env;                 ///< latitude-longitude map around the scene; empty: none
    std::uint32_t env_lights = 3000;           ///< that stand for it; 0: it is only seen
    float env_scale = 1.0f;                    ///< of its radiance
    float env_rotate = 0.0f;                   ///< degrees, counter-clockwise about +y seen from above
    std::optional<lightcuts::SunPosition> sun_sky;
    float turbidity = 3.0f;           ///< of the air, with `sun_sky`, whose own does not count
    std::uint32_t sky_lights = 5000;  ///< that stand for the sky; 0: it is only seen
    float ground = 0.2f;              ///< albedo of what is below the horizon, with `sun_sky`
    std::uint32_t indirect = 0;       ///< about so many virtual lights; 0: direct light only
    float fog = 0.0f;                 ///< extinction of the medium in the scene's box, per unit of length; 0: none
    float fog_albedo = 0.9f;          ///< share of the light that it scatters
    float fog_anisotropy = 0.0f;      ///< mean cosine of its scattering
    float aperture = 0.0f;            ///< diameter of the lens, in units of the scene; 0: a pinhole
    std::optional<float> focus;       ///< distance of what is sharp; empty: that of the target
    std::string filter = "box";       ///< of pixels: one of pixel_filters()
    /// Of virtual lights, by methods that clamp.
    lightcuts::ClampingOptions clamp = lightcuts::automatic_clamping;
    bool diffuse_materials = false;   ///< everything is Lambert with its base color
    std::filesystem::path reference;  ///< picture to compare with; empty: none
    std::string isa;                  ///< of the ray tracer, one of isa_names(); empty: what Embree chooses
    std::vector<std::string> aovs;    ///< further layers, each of `aov_names()`
    int threads = 0;                  ///< 0: all
    std::uint64_t seed = 1;
    bool quiet = false;

    bool resume = false;  ///< go on with an interrupted picture

    std::vector<std::string> given;        ///< long names of those that the command line sets
    std::vector<std::string> given_texts;  ///< what it sets each of them to

    bool is_given(const std::string& name) const;
    bool has_aov(const std::string& name) const;

    /// The method shades a pixel's gather points at once: `multidimensional`, `unified-cut`.
    bool sums_pixels() const;
    /// `--clamp` or `--clamp-ratio` are on the command line.
    bool is_clamp_given() const { return is_given("--clamp") || is_given("--clamp-ratio"); }
    /// What the method does to virtual lights: nothing if it is none of those that clamp. Methods that sum pixels clamp
    /// by share, and only if they are told to: else by transfer, where the eye's adaptation is known.
    lightcuts::ClampingOptions clamping() const;
    /// Virtual lights would be clamped, but not by this method.
    bool is_clamp_idle() const { return clamp.has_threshold() && !clamping().has_threshold(); }
};

const std::vector<std::string>& clamping_methods();
const std::vector<std::string>& aov_names();

/// throws: usage_error for an unknown option, a bad value, or an option that a later version will bring.
Options parse_options(int argc, const char* const* argv);

/// The words separated by commas.
std::string listed(const std::vector<std::string>& words);

}  // namespace render
