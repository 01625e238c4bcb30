#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>
#include <render/io/picture.hpp>
#include <render/lights/background.hpp>
#include <render/scene.hpp>
#include <render/surfaces/surface_lobes.hpp>

#include "bounce.hpp"
#include "illumination.hpp"
#include "material_change.hpp"
#include "nearest_direction.hpp"
#include "options.hpp"
#include "prepared_scene.hpp"
#include "relit_shader.hpp"
#include "seen_points.hpp"

namespace relight {

/// What a picture shows of a scene under a map.
struct FrameState {
    render::Camera camera;
    double rotation = 0.0;  ///< of the map: degrees, counter-clockwise seen from above
    MaterialChange materials;
    int width = 0;
    int height = 0;

    /// True for the same picture, to the last bit.
    bool operator==(const FrameState& other) const;
};

/// What a picture took.
struct FrameFigures {
    std::size_t points = 0;            ///< seen
    double mean_visibility_cut = 0.0;  ///< of the cuts in use
    std::size_t illumination_cut = 0;  ///< size
    RelitStatistics relit;
    std::size_t bounce_cut = 0;  ///< size of the cut of reflected light; 0: there is none
    double seconds_light = 0.0;  ///< to turn the map and to cut it; 0 if it was there already
    double seconds_shade = 0.0;

    double nodes_per_triangle() const;
    double clusters_per_point() const;
    double directions_per_glossy_point() const;
};

/// Makes pictures of a scene, and keeps of each what the next may need: eye rays are traced again where the camera, the
/// size or the kind of materials has changed, and the map is turned again where its rotation has.
/// threads: those of the calling arena, by one call at a time; pictures do not depend on how many there are.
class FrameSource {
public:
    /// `options` and `prepared` must outlive this object. Of the options those of light and its samples count, not
    /// those that a FrameState has. throws: invalid_input for a map that cannot be used.
    FrameSource(const Options& options, const PreparedScene& prepared, render::Environment environment);
    FrameSource(const FrameSource&) = delete;
    FrameSource& operator=(const FrameSource&) = delete;

    /// Traces the eye rays of `state` and reads the cuts that they meet, as `picture` does first. False if the
    /// calling task group was canceled meanwhile; then there is nothing to be seen. throws: invalid_input for a
    /// damaged cut.
    bool look(const FrameState& state);

    /// Nothing if the calling task group was canceled meanwhile. throws: as `look`.
    std::optional<render::Picture> picture(const FrameState& state);

    /// Of the last call.
    const FrameFigures& figures() const { return figures_; }

private:
    void change_materials(const MaterialChange& change);
    bool light(double rotation);
    void shade();
    void add_bounce_exhaustively();
    render::Picture compose() const;

    const Options& options_;
    const PreparedScene& prepared_;
    render::Environment environment_;
    SplitMap map_;
    NearestDirection nearest_;
    std::vector<glm::vec3> power_;  ///< by direction
    Illumination illumination_;
    std::optional<double> rotation_;  ///< of both

    SeenPoints seen_;
    std::vector<render::SurfaceLobes> own_lobes_;  ///< by point, of the scene's own materials
    std::optional<FrameState> seen_of_;
    std::optional<RelitShader> shader_;
    std::optional<Bounce> bounce_;
    std::vector<glm::vec3> radiance_;  ///< by point
    FrameFigures figures_;
};

}  // namespace relight
