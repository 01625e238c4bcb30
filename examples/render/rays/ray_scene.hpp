#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "rays/embree.hpp"
#include "rays/ray_tracer.hpp"
#include "scene.hpp"

namespace render {

/// Where an eye ray meets the mesh: the point is (1 - u - v) a + u b + v c on `triangle`'s corners a, b, c.
struct Hit {
    std::uint32_t triangle = 0;
    float u = 0;
    float v = 0;
    float distance = 0;
    float time = 0;  ///< of the ray
};

/// How a scene is put into the ray tracer.
struct RayOptions {
    /// Rays do not slip between triangles that share an edge. Without, they are a little faster, and one in five of
    /// those that meet an edge passes: only what measures the difference wants that. In either case a ray through a
    /// corner, to within rounding, may pass.
    bool robust = true;
};

/// A scene's triangles in Embree. Triangles that let light pass (transmission, alpha) lie in a geometry of their own
/// with filter functions; the others never meet a filter, and a scene without transmissive surfaces has none. What
/// moves lies in further geometries; rays have a `time`, from 0 as the shutter opens to 1 as it closes. threads: all
/// queries may run at once.
class RayScene {
public:
    /// `scene` must outlive this object. throws std::runtime_error if Embree fails.
    explicit RayScene(const Scene& scene, const RayTracer& tracer = RayTracer(), const RayOptions& options = {});
    ~RayScene();
    RayScene(const RayScene&) = delete;
    RayScene& operator=(const RayScene&) = delete;

    /// Nearest surface along the unit `direction`; passes where an alpha mask has a hole.
    std::optional<Hit> nearest(const glm::vec3& origin, const glm::vec3& direction, float time = 0.0f) const;

    /// True iff some surface passes light. Then shadow rays go through `to_point` and `to_infinity`; otherwise
    /// plain occlusion queries of `embree_scene()` (single, packets or streams) answer the same.
    bool transmissive() const { return transmissive_; }

    /// Share of light that travels between two points, each channel in [0, 1]: the product of the tints of the layers
    /// between them. What lies in one place is one layer, as for eye rays that go on from there at the distance of
    /// `SurfaceGeometry::leave`; the least transmitting counts. The ray stops a few steps of a float short of `to`.
    glm::vec3 to_point(const glm::vec3& from, const glm::vec3& to, float time = 0.0f) const;

    /// The same towards infinity; `direction` leads away from `from`.
    glm::vec3 to_infinity(const glm::vec3& from, const glm::vec3& direction, float time = 0.0f) const;

    /// For occlusion queries by others. pre: `!transmissive()`, as the filters expect a context of this class.
    RTCScene embree_scene() const { return scene_; }
    const RayTracer& tracer() const { return tracer_; }

    /// Shadow rays end at this share of the way: a ray's own rounding may not carry it beyond its end.
    static constexpr float shadow_ray_end = 1.0f - 0x1p-23f;

private:
    struct Ray;
    static void skip_holes(const RTCFilterFunctionNArguments* arguments);
    static void pass_light(const RTCFilterFunctionNArguments* arguments);

    void add_geometry(std::vector<std::uint32_t> triangles, bool with_filters, const MovingVertices* motion = nullptr);
    glm::vec3 pass(const glm::vec3& from, const glm::vec3& direction, float end, float time) const;

    const Scene& source_;
    RayTracer tracer_;
    RTCScene scene_ = nullptr;
    bool transmissive_ = false;
    std::vector<std::vector<std::uint32_t>> triangles_;  ///< of each geometry, by primitive
};

}  // namespace render
