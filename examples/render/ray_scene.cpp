#include "ray_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>

#include "memory.hpp"
#include "surface_colors.hpp"

namespace render {

namespace {

constexpr unsigned opaque_geometry = 0;
constexpr unsigned translucent_geometry = 1;

/// Below this a ray counts as blocked: less than a step of an 8-bit picture.
constexpr float blocked_below = 1e-4f;

/// Where a shadow ray has passed through a surface.
struct Passage {
    std::uint32_t triangle = 0;
    float distance = 0;
};

/// A shadow ray's context: Embree hands it to the filter, which multiplies the tints.
struct LightContext {
    QueryContext embree;
    glm::vec3 passed{1.0f};
    std::array<Passage, 4> last;  ///< the latest passages, in a ring
    unsigned passages = 0;        ///< so far
};

/// True iff two corners of each lie at the same places.
bool share_an_edge(const Scene& scene, std::uint32_t a, std::uint32_t b) {
    const auto is_corner_of_b = [&](std::uint32_t corner) {
        const glm::uvec3 t = scene.triangles[b];
        const glm::vec3& p = scene.positions[corner];
        return p == scene.positions[t.x] || p == scene.positions[t.y] || p == scene.positions[t.z];
    };
    const glm::uvec3 t = scene.triangles[a];
    return int{is_corner_of_b(t.x)} + int{is_corner_of_b(t.y)} + int{is_corner_of_b(t.z)} == 2;
}

/// Notes a passage. False if it is one that is known: a ray through an edge meets the triangles on both sides of it.
bool is_new(const Scene& scene, const Passage& here, LightContext& context) {
    constexpr float same_distance = 1e-4f;  // relative: planes that meet at the edge are intersected each on its own
    const unsigned known = std::min<unsigned>(context.passages, static_cast<unsigned>(context.last.size()));
    for (unsigned i = 0; i < known; ++i) {
        const Passage& other = context.last[i];
        const bool near = std::abs(here.distance - other.distance) <= same_distance * here.distance;
        if (near && share_an_edge(scene, here.triangle, other.triangle)) return false;
    }
    context.last[context.passages++ % context.last.size()] = here;
    return true;
}

RTCRay make_ray(const glm::vec3& origin, const glm::vec3& direction, float end) {
    RTCRay ray{};
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tnear = 0;
    ray.tfar = end;
    ray.mask = ~0u;
    return ray;
}

/// What Embree last said in this thread.
thread_local std::string embree_words;

void keep_words(void*, RTCError, const char* words) { embree_words = words ? words : ""; }

/// Embree gives a thread or a block that the system refuses any of two names.
void require(RTCDevice device) {
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) return;
    if (error == RTC_ERROR_OUT_OF_MEMORY || is_memory_short()) throw std::bad_alloc();
    throw std::runtime_error("Embree failed with error " + std::to_string(static_cast<int>(error)) + ": " +
                             embree_words);
}

}  // namespace

RayScene::RayScene(const Scene& scene, const RayTracer& tracer, const RayOptions& options)
    : source_(scene), tracer_(tracer) {
    const std::vector<bool> passes = transmissive_materials(scene);
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        (passes[scene.triangle_material[t]] ? translucent_ : opaque_).push_back(t);
    }
    transmissive_ = !translucent_.empty();

    rtcSetDeviceErrorFunction(tracer_.device(), keep_words, nullptr);
    scene_ = rtcNewScene(tracer_.device());
    try {
        // A high-quality hierarchy would split triangles and report one surface twice to the filters.
        rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);
        if (options.robust) rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        if (!opaque_.empty()) add_geometry(opaque_, false);
        if (!translucent_.empty()) add_geometry(translucent_, true);
        rtcCommitScene(scene_);
        require(tracer_.device());
    } catch (...) {
        rtcReleaseScene(scene_);
        throw;
    }
}

RayScene::~RayScene() { rtcReleaseScene(scene_); }

void RayScene::add_geometry(const std::vector<std::uint32_t>& triangles, bool with_filters) {
    RTCGeometry geometry = rtcNewGeometry(tracer_.device(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), source_.positions.size()));
    auto* corners = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), triangles.size()));
    if (!positions || !corners) {
        rtcReleaseGeometry(geometry);
        require(tracer_.device());
    }
    std::copy(source_.positions.begin(), source_.positions.end(), positions);
    for (std::size_t i = 0; i < triangles.size(); ++i) corners[i] = source_.triangles[triangles[i]];
    if (with_filters) {
        rtcSetGeometryUserData(geometry, this);
        rtcSetGeometryIntersectFilterFunction(geometry, &RayScene::skip_holes);
        rtcSetGeometryOccludedFilterFunction(geometry, &RayScene::pass_light);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_, geometry, with_filters ? translucent_geometry : opaque_geometry);
    rtcReleaseGeometry(geometry);
    require(tracer_.device());
}

std::optional<Hit> RayScene::nearest(const glm::vec3& origin, const glm::vec3& direction) const {
    RTCRayHit query{};
    query.ray = make_ray(origin, direction, std::numeric_limits<float>::infinity());
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    QueryContext context;
    init_context(context);
    intersect(scene_, context, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const auto& triangles = query.hit.geomID == opaque_geometry ? opaque_ : translucent_;
    return Hit{triangles[query.hit.primID], query.hit.u, query.hit.v, query.ray.tfar};
}

glm::vec3 RayScene::pass(const glm::vec3& from, const glm::vec3& direction, float end) const {
    RTCRay ray = make_ray(from, direction, end);
    LightContext context;
    init_context(context.embree);
    occluded(scene_, context.embree, ray);
    // Embree marks a blocked ray by a negative end.
    return ray.tfar < 0 ? glm::vec3(0.0f) : context.passed;
}

glm::vec3 RayScene::to_point(const glm::vec3& from, const glm::vec3& to) const {
    return pass(from, to - from, shadow_ray_end);
}

glm::vec3 RayScene::to_infinity(const glm::vec3& from, const glm::vec3& direction) const {
    return pass(from, direction, std::numeric_limits<float>::infinity());
}

void RayScene::skip_holes(const RTCFilterFunctionNArguments* arguments) {
    const auto& self = *static_cast<const RayScene*>(arguments->geometryUserPtr);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        const std::uint32_t triangle = self.translucent_[RTCHitN_primID(arguments->hit, arguments->N, i)];
        const float u = RTCHitN_u(arguments->hit, arguments->N, i);
        const float v = RTCHitN_v(arguments->hit, arguments->N, i);
        if (cover_at(self.source_, triangle, u, v) == 0.0f) arguments->valid[i] = 0;
    }
}

void RayScene::pass_light(const RTCFilterFunctionNArguments* arguments) {
    const auto& self = *static_cast<const RayScene*>(arguments->geometryUserPtr);
    // Only `pass` traces occlusion rays against a scene with filters: one ray a query.
    if (arguments->valid[0] == 0) return;
    auto& context = *reinterpret_cast<LightContext*>(arguments->context);
    const std::uint32_t triangle = self.translucent_[RTCHitN_primID(arguments->hit, 1, 0)];
    const Passage here{triangle, RTCRayN_tfar(arguments->ray, 1, 0)};
    if (!is_new(self.source_, here, context)) {
        arguments->valid[0] = 0;
        return;
    }
    context.passed *= tint_at(self.source_, triangle, RTCHitN_u(arguments->hit, 1, 0), RTCHitN_v(arguments->hit, 1, 0));
    const glm::vec3& passed = context.passed;
    const bool blocked = std::max({passed.x, passed.y, passed.z}) < blocked_below;
    if (!blocked) arguments->valid[0] = 0;
}

}  // namespace render
