#pragma once

#include <cstdint>
#include <string>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "scene.hpp"

namespace render {

struct EyeRay {
    glm::vec3 origin{0.0f};
    glm::vec3 direction{0.0f};  ///< unit
    std::uint32_t instant = 0;  ///< of the scene's
};

/// Where sample `sample` of `spp` lies within a pixel, [0, 1)^2: the center if it is the only one, else points that
/// cover the pixel evenly, shifted by a hash of (seed, pixel).
glm::vec2 pixel_offset(std::uint64_t seed, std::uint32_t pixel, int sample, int spp);

/// A point in the pixel, and one in the unit square for the lens: together they cover all four dimensions evenly.
struct LensSample {
    glm::vec2 offset{0.5f};
    glm::vec2 lens{0.0f};  ///< (0, any) is its center
};
LensSample lens_sample(std::uint64_t seed, std::uint32_t pixel, int sample, int spp);

/// A thin lens [Cook et al. 1984]: what lies in the plane at `focus`, measured along the view, is sharp.
struct Lens {
    double aperture = 0.0;  ///< diameter; 0: a pinhole
    double focus = 1.0;     ///< pre: > 0
};

/// A pinhole camera, or an orthographic one, either with a lens or without, in front of a grid of square pixels; (0, 0)
/// is the top left corner of the picture.
class View {
public:
    /// `origin`: of the coordinates that rays are wanted in, as Scene::origin.
    /// pre: width, height > 0; `require_usable` accepts the camera.
    View(const Camera& camera, const glm::dvec3& origin, int width, int height, const Lens& lens = {});

    /// The ray through (x, y), in pixels.
    EyeRay ray(float x, float y) const;
    /// The ray through (x, y) and the point of the lens that belongs to `lens` of the unit square.
    EyeRay ray(float x, float y, const glm::vec2& lens) const;

    bool has_lens() const { return lens_.aperture > 0.0; }

    int width() const { return width_; }
    int height() const { return height_; }

private:
    int width_;
    int height_;
    glm::vec3 eye_;
    glm::vec3 forward_;
    glm::vec3 right_;   ///< one pixel to the right, on the image plane at distance 1; orthographic: in space
    glm::vec3 down_;    ///< one pixel down
    glm::vec3 corner_;  ///< from the eye to the top left corner; orthographic: from the middle of the picture
    bool is_orthographic_;
    Lens lens_;
};

/// throws: invalid_input, in one line that begins with `where`, unless `camera` spans a picture: all coordinates
/// finite, target apart from the eye, distances that can be squared, up not along the view, field of view within
/// (0, 180) degrees.
void require_usable(const Camera& camera, const std::string& where);

/// An up vector for a camera that has been given none: +y, or -z when it looks along y.
glm::vec3 default_up(const glm::dvec3& eye, const glm::dvec3& target);

}  // namespace render
