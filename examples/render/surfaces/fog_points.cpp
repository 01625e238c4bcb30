#include "surfaces/fog_points.hpp"

#include <cmath>

#include <lightcuts/core/random.hpp>

namespace render {

float add_fog_points(const Fog& fog, const RaySegment& segment, std::uint32_t& vertex,
                     std::vector<SurfacePoint>& points) {
    const double extinction = static_cast<double>(fog.medium.extinction());
    const double begin = fog.medium.way_before(segment.origin, segment.direction);
    const double way = fog.medium.way_inside(segment.origin, segment.direction, static_cast<double>(segment.length));
    const double hidden = -std::expm1(-extinction * way);
    if (!(hidden > 0.0)) return 1.0f;
    const auto transmittance = static_cast<float>(1.0 - hidden);
    const auto count = static_cast<int>(std::ceil(static_cast<double>(fog.points_per_ray) * hidden));
    const glm::vec3 weight = segment.weight * (fog.albedo * static_cast<float>(hidden / count));
    if (weight == glm::vec3(0.0f)) return transmittance;
    constexpr double golden = 0.6180339887498949;
    for (int i = 0; i < count; ++i, ++vertex) {
        const double shift = lightcuts::uniform01(lightcuts::hash_keys(segment.pixel, vertex)) +
                             golden * segment.sample;
        const double quantile = (static_cast<double>(i) + shift - std::floor(shift)) / count;
        const double distance = begin + std::fmin(-std::log1p(-quantile * hidden) / extinction, way);
        SurfacePoint point;
        point.model = SurfacePoint::Model::volume;
        point.shininess = fog.anisotropy;
        point.position = point.ray_origin = segment.origin + static_cast<float>(distance) * segment.direction;
        point.to_viewer = point.geometric_normal = point.shading_normal = -segment.direction;
        point.distance = segment.traveled + static_cast<float>(distance);
        point.weight = weight;
        point.pixel = segment.pixel;
        point.sample = segment.sample;
        point.vertex = vertex;
        point.instant = segment.instant;
        points.push_back(point);
    }
    return transmittance;
}

}  // namespace render
