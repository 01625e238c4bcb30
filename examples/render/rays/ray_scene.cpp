#include "rays/ray_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

#include "memory.hpp"
#include "motion.hpp"
#include "surfaces/surface_colors.hpp"
#include "triangle.hpp"

namespace render {

namespace {

/// Below this a ray counts as blocked: less than a step of an 8-bit picture.
constexpr float blocked_below = 1e-4f;

/// Where a shadow ray meets a surface that lets light pass. Without initial values, as each ray has room for many.
struct Passage {
    std::uint32_t triangle;
    float distance;
    float u;
    float v;
    glm::vec3 tint;
};

/// The most passages of a shadow ray: twice as many as the layers through which eye rays pass.
constexpr std::size_t most_passages = 128;

/// A shadow ray's context: Embree hands it to the filter, which notes the passages, in any order.
struct LightContext {
    QueryContext embree;
    glm::vec3 direction;
    float time = 0;
    std::size_t count = 0;
    glm::vec3 product{1.0f};  ///< of all tints: at most what passes
    std::array<Passage, most_passages> passages;
};

/// A total order of tints.
bool is_darker(const glm::vec3& a, const glm::vec3& b) {
    const auto key = [](const glm::vec3& tint) { return std::tuple(tint.r + tint.g + tint.b, tint.r, tint.g); };
    return key(a) < key(b);
}

/// True iff both lie on one edge of their triangles, up to rounding: a ray through an edge meets both of its sides.
bool are_on_one_edge(const Scene& scene, const Passage& a, const Passage& b, float time) {
    constexpr float at_edge = 1e-5f;
    const Triangle s = triangle_at(scene, a.triangle, time);
    const Triangle t = triangle_at(scene, b.triangle, time);
    const auto is_at_common_edge = [&](const Triangle& own, const Triangle& other, const Passage& p) {
        int common = 0;
        float coordinate = 1.0f;
        const auto look_at = [&](const glm::dvec3& corner, float opposite) {
            if (corner == other.a || corner == other.b || corner == other.c) {
                ++common;
            } else {
                coordinate = opposite;
            }
        };
        look_at(own.a, 1.0f - p.u - p.v);
        look_at(own.b, p.u);
        look_at(own.c, p.v);
        return common == 2 && std::abs(coordinate) <= at_edge;
    };
    return is_at_common_edge(s, t, a) && is_at_common_edge(t, s, b);
}

/// Where an eye ray goes on from a layer.
struct Start {
    glm::dvec3 position;

    Start(const Scene& scene, const Passage& layer, const glm::dvec3& direction, float time) {
        const Triangle triangle = triangle_at(scene, layer.triangle, time);
        position = triangle.at(static_cast<double>(layer.u), static_cast<double>(layer.v));
        const glm::dvec3 cross = triangle.cross();
        const double length = glm::length(cross);
        if (!(length > 0.0)) return;
        const double side = glm::dot(cross, direction) < 0.0 ? -1.0 : 1.0;
        position += side * static_cast<double>(ray_offset(triangle, position)) / length * cross;
    }

    /// True iff the plane of the passage lies behind, for a ray along `direction`.
    bool is_beyond(const Scene& scene, const Passage& passage, const glm::dvec3& direction, float time) const {
        const Triangle triangle = triangle_at(scene, passage.triangle, time);
        const glm::dvec3 normal = triangle.cross();
        const double height = glm::dot(triangle.a - position, normal);
        const double slope = glm::dot(direction, normal);
        return slope == 0.0 || height / slope <= 0.0;
    }
};

/// What passes all layers. Surfaces that an eye ray through a layer would begin behind belong to that layer, and so do
/// those that meet in an edge on which both are hit.
glm::vec3 light_through(const Scene& scene, LightContext& context) {
    const auto begin = context.passages.begin();
    const auto end = begin + static_cast<std::ptrdiff_t>(context.count);
    if (context.count < 2) return context.product;
    std::sort(begin, end, [](const Passage& a, const Passage& b) {
        if (a.distance != b.distance) return a.distance < b.distance;
        return is_darker(a.tint, b.tint) || (!is_darker(b.tint, a.tint) && a.triangle < b.triangle);
    });
    const glm::dvec3 direction(context.direction);
    glm::vec3 passed(1.0f);
    for (auto layer = begin; layer != end;) {
        const Start start(scene, *layer, direction, context.time);
        glm::vec3 tint = layer->tint;
        auto next = layer + 1;
        for (; next != end; ++next) {
            if (!start.is_beyond(scene, *next, direction, context.time) &&
                !are_on_one_edge(scene, *layer, *next, context.time)) {
                break;
            }
            if (is_darker(next->tint, tint)) tint = next->tint;
        }
        passed *= tint;
        layer = next;
    }
    return passed;
}

bool is_blocked(const glm::vec3& passed) { return std::max({passed.x, passed.y, passed.z}) < blocked_below; }

RTCRay make_ray(const glm::vec3& origin, const glm::vec3& direction, float end, float time) {
    RTCRay ray{};
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tnear = 0;
    ray.tfar = end;
    ray.time = time;
    ray.mask = ~0u;
    return ray;
}

/// What Embree last said in this thread.
thread_local std::string embree_words;

void keep_words(void*, RTCError, const char* words) { embree_words = words ? words : ""; }

/// throws: std::bad_alloc for a shortage of memory, which Embree reports as RTC_ERROR_OUT_OF_MEMORY or, where a thread
/// or a block is refused, as another error; std::runtime_error for any other failure.
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
    struct Group {
        std::vector<std::uint32_t> opaque;
        std::vector<std::uint32_t> translucent;
    };
    const std::vector<bool> passes = transmissive_materials(scene);
    Group still;
    std::vector<Group> moving(scene.moving.size());
    for (std::uint32_t t = 0; t < scene.triangles.size(); ++t) {
        const MovingVertices* motion = motion_of(scene, scene.triangles[t].x);
        Group& group = motion ? moving[static_cast<std::size_t>(motion - scene.moving.data())] : still;
        const bool is_translucent = passes[scene.triangle_material[t]];
        (is_translucent ? group.translucent : group.opaque).push_back(t);
        transmissive_ = transmissive_ || is_translucent;
    }

    rtcSetDeviceErrorFunction(tracer_.device(), keep_words, nullptr);
    scene_ = rtcNewScene(tracer_.device());
    try {
        // A high-quality hierarchy would split triangles and report one surface twice to the filters.
        rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);
        if (options.robust) rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        add_geometry(std::move(still.opaque), false);
        add_geometry(std::move(still.translucent), true);
        for (std::size_t i = 0; i < moving.size(); ++i) {
            add_geometry(std::move(moving[i].opaque), false, &scene.moving[i]);
            add_geometry(std::move(moving[i].translucent), true, &scene.moving[i]);
        }
        rtcCommitScene(scene_);
        require(tracer_.device());
    } catch (...) {
        rtcReleaseScene(scene_);
        throw;
    }
}

RayScene::~RayScene() { rtcReleaseScene(scene_); }

void RayScene::add_geometry(std::vector<std::uint32_t> triangles, bool with_filters, const MovingVertices* motion) {
    if (triangles.empty()) return;
    RTCGeometry geometry = rtcNewGeometry(tracer_.device(), RTC_GEOMETRY_TYPE_TRIANGLE);
    const auto fail = [&] {
        rtcReleaseGeometry(geometry);
        require(tracer_.device());
    };
    const std::span<const glm::vec3> positions = motion ? motion->positions : source_.positions;
    const std::uint32_t steps = motion ? motion->steps : 1;
    const std::size_t count = positions.size() / steps;
    const std::uint32_t first = motion ? motion->first : 0;
    if (motion) rtcSetGeometryTimeStepCount(geometry, steps);
    for (std::uint32_t step = 0; step < steps; ++step) {
        auto* to = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, step,
                                                                   RTC_FORMAT_FLOAT3, sizeof(glm::vec3), count));
        if (!to) return fail();
        std::copy_n(positions.begin() + static_cast<std::ptrdiff_t>(step * count), count, to);
    }
    auto* corners = static_cast<glm::uvec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(glm::uvec3), triangles.size()));
    if (!corners) return fail();
    for (std::size_t i = 0; i < triangles.size(); ++i) corners[i] = source_.triangles[triangles[i]] - first;
    if (with_filters) {
        rtcSetGeometryUserData(geometry, this);
        rtcSetGeometryIntersectFilterFunction(geometry, &RayScene::skip_holes);
        rtcSetGeometryOccludedFilterFunction(geometry, &RayScene::pass_light);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_, geometry, static_cast<unsigned>(triangles_.size()));
    triangles_.push_back(std::move(triangles));
    rtcReleaseGeometry(geometry);
    require(tracer_.device());
}

std::optional<Hit> RayScene::nearest(const glm::vec3& origin, const glm::vec3& direction, float time) const {
    RTCRayHit query{};
    query.ray = make_ray(origin, direction, std::numeric_limits<float>::infinity(), time);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    QueryContext context;
    init_context(context);
    intersect(scene_, context, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return Hit{triangles_[query.hit.geomID][query.hit.primID], query.hit.u, query.hit.v, query.ray.tfar, time};
}

glm::vec3 RayScene::pass(const glm::vec3& from, const glm::vec3& direction, float end, float time) const {
    RTCRay ray = make_ray(from, direction, end, time);
    LightContext context;
    init_context(context.embree);
    context.direction = direction;
    context.time = time;
    occluded(scene_, context.embree, ray);
    // Embree marks a blocked ray by a negative end.
    if (ray.tfar < 0) return glm::vec3(0.0f);
    const glm::vec3 passed = light_through(source_, context);
    return is_blocked(passed) ? glm::vec3(0.0f) : passed;
}

glm::vec3 RayScene::to_point(const glm::vec3& from, const glm::vec3& to, float time) const {
    return pass(from, to - from, shadow_ray_end, time);
}

glm::vec3 RayScene::to_infinity(const glm::vec3& from, const glm::vec3& direction, float time) const {
    return pass(from, direction, std::numeric_limits<float>::infinity(), time);
}

void RayScene::skip_holes(const RTCFilterFunctionNArguments* arguments) {
    const auto& self = *static_cast<const RayScene*>(arguments->geometryUserPtr);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        const std::uint32_t triangle = self.triangles_[RTCHitN_geomID(arguments->hit, arguments->N, i)]
                                                      [RTCHitN_primID(arguments->hit, arguments->N, i)];
        const float u = RTCHitN_u(arguments->hit, arguments->N, i);
        const float v = RTCHitN_v(arguments->hit, arguments->N, i);
        if (opacity_at(self.source_, triangle, u, v) == 0.0f) arguments->valid[i] = 0;
    }
}

void RayScene::pass_light(const RTCFilterFunctionNArguments* arguments) {
    const auto& self = *static_cast<const RayScene*>(arguments->geometryUserPtr);
    // Only `pass` traces occlusion rays against a scene with filters: one ray a query.
    if (arguments->valid[0] == 0) return;
    auto& context = *reinterpret_cast<LightContext*>(arguments->context);
    const std::uint32_t triangle = self.triangles_[RTCHitN_geomID(arguments->hit, 1, 0)]
                                                  [RTCHitN_primID(arguments->hit, 1, 0)];
    Passage here{};
    here.triangle = triangle;
    here.distance = RTCRayN_tfar(arguments->ray, 1, 0);
    here.u = RTCHitN_u(arguments->hit, 1, 0);
    here.v = RTCHitN_v(arguments->hit, 1, 0);
    here.tint = tint_at(self.source_, triangle, here.u, here.v);
    const bool is_clear = here.tint == glm::vec3(1.0f);
    const bool has_room = context.count < most_passages;
    if (!is_clear && has_room) {
        context.passages[context.count++] = here;
        context.product *= here.tint;
    }
    // The product counts a layer that is met twice twice, and so may be too small: before the ray counts as blocked,
    // the light that passes is computed from the passages.
    const bool is_dark = is_blocked(context.product) && is_blocked(light_through(self.source_, context));
    if (is_clear || (has_room && !is_dark)) arguments->valid[0] = 0;
}

}  // namespace render
