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

/// A visibility oracle over an Embree scene of opaque geometry (version 3 or 4). Refers to the scene, which must be
/// committed and outlive it. Safe to call from several threads.
/// Give the scene the flag RTC_SCENE_FLAG_ROBUST: without it, rays that meet an edge may slip between its two
/// triangles, and light leaks through closed walls in lines. Rays take somewhat longer for it. `many` traces incoherent
/// streams with Embree 3; version 4 has no streams, and rays go one by one.
class EmbreeOracle {
public:
    /// `shorten`: the fraction of a shadow ray left out at the light's end, so that lights that lie on a surface are
    /// not hidden by it.
    explicit EmbreeOracle(RTCScene scene, float shorten = 1e-4f) : scene_(scene), reach_(1.0f - shorten) {}

    template <class R, Light L>
    bool operator()(const R& receiver, const L& light) const {
        RTCRay ray;
        aim(ray, receiver.shadow_origin, position_or_direction(light), DirectionalLight<L>);
        return !occluded(ray);
    }

    void many(std::span<const VisibilityQuery> queries, std::span<float> answers) const {
        many(queries, answers, [](const VisibilityQuery& q) { return q.to; });
    }
    /// The same with rays that end elsewhere: before the surface of an emitter, say. `end_of(query)` is not called for
    /// distant lights. A ray that ends where it starts meets nothing.
    template <class EndOf>
    void many(std::span<const VisibilityQuery> queries, std::span<float> answers, const EndOf& end_of) const {
        constexpr std::size_t stream = 256;
        RTCRay rays[stream];
        for (std::size_t begin = 0; begin < queries.size(); begin += stream) {
            const std::size_t count = (std::min)(stream, queries.size() - begin);
            for (std::size_t i = 0; i < count; ++i) {
                const VisibilityQuery& q = queries[begin + i];
                aim(rays[i], q.from, q.distant ? q.to : end_of(q), q.distant);
            }
            occluded(rays, count);
            for (std::size_t i = 0; i < count; ++i) answers[begin + i] = rays[i].tfar < 0.0f ? 0.0f : 1.0f;
        }
    }

private:
    /// Field by field: a copy of what was just written in pieces stalls.
    void aim(RTCRay& ray, const glm::vec3& from, const glm::vec3& to, bool distant) const {
        const glm::vec3 direction = distant ? to : to - from;
        ray.org_x = from.x;
        ray.org_y = from.y;
        ray.org_z = from.z;
        // Of no length: not active.
        ray.tnear = direction == glm::vec3(0.0f) ? 2.0f : 0.0f;
        ray.dir_x = direction.x;
        ray.dir_y = direction.y;
        ray.dir_z = direction.z;
        ray.time = 0.0f;
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
