#include "cluster_lights.hpp"

#include <glm/geometric.hpp>
#include <lightcuts/core/lanes.hpp>
#include <lightcuts/core/vectorized.hpp>

namespace relight {

template <class F>
void ClusterLights::for_each_lane(F&& f) {
    for (std::vector<float>* lane : {&x_, &y_, &z_}) f(*lane);
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::vector<float>* lane : {&red_[k], &green_[k], &blue_[k]}) f(*lane);
    }
}

void ClusterLights::clear() {
    nodes_.clear();
    ends_.clear();
    radii_.clear();
    for_each_lane([](std::vector<float>& lane) { lane.clear(); });
    power_ = glm::mat3(0.0f);
    towards_ = glm::vec3(0.0f);
}

void ClusterLights::add(std::uint32_t node, const Illumination::Light& light, const glm::vec3& visible) {
    nodes_.push_back({node, visible});
    for (int k = 0; k < 3; ++k) power_[k] += light.power * visible[k];
    // A little in any case, so that a cluster without light has a direction, too.
    const float seen = (light.power.x + light.power.y + light.power.z) * (visible.x + visible.y + visible.z);
    towards_ += light.direction * (seen + 1e-30f);
}

void ClusterLights::end_cluster(float radius) {
    if (nodes_.size() == (ends_.empty() ? 0 : ends_.back())) return;
    const float length = glm::length(towards_ * 1e15f);  // of what may be tiny
    const glm::vec3 towards = length > 0.0f ? towards_ * 1e15f / length : glm::vec3(0.0f, 1.0f, 0.0f);
    x_.push_back(towards.x);
    y_.push_back(towards.y);
    z_.push_back(towards.z);
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec3& power = power_[static_cast<int>(k)];
        red_[k].push_back(power.x);
        green_[k].push_back(power.y);
        blue_[k].push_back(power.z);
    }
    ends_.push_back(nodes_.size());
    radii_.push_back(radius);
    power_ = glm::mat3(0.0f);
    towards_ = glm::vec3(0.0f);
}

void ClusterLights::finish() {
    for_each_lane([](std::vector<float>& lane) {
        while (lane.size() % lightcuts::lane_count != 0) lane.push_back(0.0f);
    });
}

LIGHTCUTS_VECTORIZED glm::vec3 ClusterLights::irradiance(const glm::vec3& corners, const glm::vec3& normal,
                                                         const glm::vec3& horizon) const {
    constexpr int lanes = lightcuts::lane_count;
    alignas(32) float red[lanes] = {}, green[lanes] = {}, blue[lanes] = {};
    const glm::vec3 w = corners, n = normal, h = horizon;
    for (std::size_t begin = 0; begin < x_.size(); begin += lanes) {
        const float *x = &x_[begin], *y = &y_[begin], *z = &z_[begin];
        const float *ra = &red_[0][begin], *rb = &red_[1][begin], *rc = &red_[2][begin];
        const float *ga = &green_[0][begin], *gb = &green_[1][begin], *gc = &green_[2][begin];
        const float *ba = &blue_[0][begin], *bb = &blue_[1][begin], *bc = &blue_[2][begin];
        for (int i = 0; i < lanes; ++i) {
            const float cosine = n.x * x[i] + n.y * y[i] + n.z * z[i];
            const float above = h.x * x[i] + h.y * y[i] + h.z * z[i];
            const float lit = lightcuts::detail::select(lightcuts::detail::smaller(cosine, above) > 0.0f, cosine, 0.0f);
            red[i] += lit * (w.x * ra[i] + w.y * rb[i] + w.z * rc[i]);
            green[i] += lit * (w.x * ga[i] + w.y * gb[i] + w.z * gc[i]);
            blue[i] += lit * (w.x * ba[i] + w.y * bb[i] + w.z * bc[i]);
        }
    }
    glm::vec3 sum(0.0f);
    for (int i = 0; i < lanes; ++i) sum += glm::vec3(red[i], green[i], blue[i]);
    return sum;
}

}  // namespace relight
