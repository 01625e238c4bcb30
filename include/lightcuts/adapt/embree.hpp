#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>

#include "../light/incidence.hpp"
#include "../visibility/query.hpp"

namespace lightcuts {

/// A visibility oracle over a scene of Embree 3 or 4 whose geometry is opaque: a light is visible unless something
/// stands between it and the receiver's shadow origin. A ScalarOracle and a BatchedOracle.
///
/// Refers to the scene, which must be committed and outlive the oracle. Give it the flag RTC_SCENE_FLAG_ROBUST: without
/// it a ray that meets an edge may pass between the two triangles there, and light leaks through closed walls along
/// lines; with it rays take somewhat longer. threads: safe to call from several.
class EmbreeOracle {
public:
    /// An oracle over `scene`. `shorten`: the fraction of each shadow ray that is left out at the light's end, so that
    /// a light on a surface is not hidden by that surface; in [0, 1). Rays towards distant lights have no end.
    explicit EmbreeOracle(RTCScene scene, float shorten = 1e-4f) : scene_(scene), reach_(1.0f - shorten) {}

    /// True if nothing stands between `receiver.shadow_origin` and `light` at `time`, 0 to 1, where geometry moves.
    /// cost: one ray
    template <class R, Light L>
    bool operator()(const R& receiver, const L& light, float time = 0.0f) const {
        RTCRay ray;
        aim(ray, receiver.shadow_origin, position_or_direction(light), DirectionalLight<L>, time);
        return !occluded(ray);
    }

    /// Traces one shadow ray for each query: answers[i] is 0 if something stands between the ends of queries[i], else
    /// 1. Embree 3 traces up to 256 at a time as an incoherent stream; Embree 4 has no streams and traces one by one.
    /// pre: answers.size() >= queries.size()
    void many(std::span<const VisibilityQuery> queries, std::span<float> answers) const {
        many(queries, answers, [](const VisibilityQuery& q) { return q.to; });
    }
    /// Traces one shadow ray for each query from `query.from` to `end_of(query)` in place of the light's position: to a
    /// point before an emitter's surface, say. answers[i] is 0 if something stands between the ends of ray i, else 1.
    /// Rays towards distant lights have no end: `end_of` is not called for them. A ray that ends where it starts meets
    /// nothing. Streams are those of `many` without `end_of`. pre: answers.size() >= queries.size()
    template <class EndOf>
    void many(std::span<const VisibilityQuery> queries, std::span<float> answers, const EndOf& end_of) const {
        many(queries, answers, end_of, [](const VisibilityQuery&) { return 0.0f; });
    }
    /// As `many` with `end_of`, where geometry moves: `time_of(query)`, 0 to 1, is the time at which the ray of a query
    /// is traced. A query says of which receiver it is; the caller knows that one's time.
    template <class EndOf, class TimeOf>
    void many(std::span<const VisibilityQuery> queries, std::span<float> answers, const EndOf& end_of,
              const TimeOf& time_of) const {
        constexpr std::size_t stream = 256;
        RTCRay rays[stream];
        for (std::size_t begin = 0; begin < queries.size(); begin += stream) {
            const std::size_t count = (std::min)(stream, queries.size() - begin);
            for (std::size_t i = 0; i < count; ++i) {
                const VisibilityQuery& q = queries[begin + i];
                aim(rays[i], q.from, q.distant ? q.to : end_of(q), q.distant, time_of(q));
            }
            occluded(rays, count);
            for (std::size_t i = 0; i < count; ++i) answers[begin + i] = rays[i].tfar < 0.0f ? 0.0f : 1.0f;
        }
    }

private:
    /// Sets up `ray`, field by field: copying a whole ray right after its fields were written stalls the processor.
    void aim(RTCRay& ray, const glm::vec3& from, const glm::vec3& to, bool distant, float time) const {
        const glm::vec3 direction = distant ? to : to - from;
        ray.org_x = from.x;
        ray.org_y = from.y;
        ray.org_z = from.z;
        // A ray of no length is made inactive: its interval is empty.
        ray.tnear = direction == glm::vec3(0.0f) ? 2.0f : 0.0f;
        ray.dir_x = direction.x;
        ray.dir_y = direction.y;
        ray.dir_z = direction.z;
        ray.time = time;
        ray.tfar = distant ? std::numeric_limits<float>::infinity() : reach_;
        ray.mask = ~0u;
        ray.id = 0;
        ray.flags = 0;
    }

#if RTC_VERSION_MAJOR >= 4
    bool occluded(RTCRay& ray) const {
        rtcOccluded1(scene_, &ray);
        return ray.tfar < 0.0f;
    }
    void occluded(RTCRay* rays, std::size_t count) const {
        for (std::size_t i = 0; i < count; ++i) rtcOccluded1(scene_, &rays[i]);
    }
#else
    bool occluded(RTCRay& ray) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcOccluded1(scene_, &context, &ray);
        return ray.tfar < 0.0f;
    }
    void occluded(RTCRay* rays, std::size_t count) const {
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcOccluded1M(scene_, &context, rays, static_cast<unsigned>(count), sizeof(RTCRay));
    }
#endif

    RTCScene scene_;
    float reach_;
};

}  // namespace lightcuts
