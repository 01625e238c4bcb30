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
    weight_ = 0.0f;
}

void ClusterLights::add(std::uint32_t node, const glm::vec3& where, const glm::vec3& power, const glm::vec3& visible) {
    nodes_.push_back({node, visible});
    for (int k = 0; k < 3; ++k) power_[k] += power * visible[k];
    // A little in any case, so that a cluster without light has a direction, too.
    const float seen = (power.x + power.y + power.z) * (visible.x + visible.y + visible.z) + 1e-30f;
    towards_ += where * seen;
    weight_ += seen;
}

void ClusterLights::end_cluster(float radius) {
    if (nodes_.size() == (ends_.empty() ? 0 : ends_.back())) return;
    const float length = glm::length(towards_ * 1e15f);  // of what may be tiny
    append(length > 0.0f ? towards_ * 1e15f / length : glm::vec3(0.0f, 1.0f, 0.0f), radius);
}

void ClusterLights::end_cluster_of_places(float radius) {
    if (nodes_.size() == (ends_.empty() ? 0 : ends_.back())) return;
    append(towards_ / weight_, radius);
}

void ClusterLights::append(const glm::vec3& where, float radius) {
    x_.push_back(where.x);
    y_.push_back(where.y);
    z_.push_back(where.z);
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
    weight_ = 0.0f;
}

void ClusterLights::finish() {
    for_each_lane([](std::vector<float>& lane) {
        while (lane.size() % lightcuts::lane_count != 0) lane.push_back(0.0f);
    });
}

template <bool OfPlaces>
[[gnu::always_inline]] inline glm::vec3 ClusterLights::irradiance_at(const glm::vec3& corners, const glm::vec3& from,
                                                                     const glm::vec3& normal,
                                                                     const glm::vec3& horizon) const {
    constexpr int lanes = lightcuts::lane_count;
    alignas(32) float red[lanes] = {}, green[lanes] = {}, blue[lanes] = {};
    const glm::vec3 w = corners, n = normal, h = horizon, p = from;
    for (std::size_t begin = 0; begin < x_.size(); begin += lanes) {
        const float *x = &x_[begin], *y = &y_[begin], *z = &z_[begin];
        const float *ra = &red_[0][begin], *rb = &red_[1][begin], *rc = &red_[2][begin];
        const float *ga = &green_[0][begin], *gb = &green_[1][begin], *gc = &green_[2][begin];
        const float *ba = &blue_[0][begin], *bb = &blue_[1][begin], *bc = &blue_[2][begin];
        for (int i = 0; i < lanes; ++i) {
            float cosine, above;
            if constexpr (OfPlaces) {
                const float dx = x[i] - p.x, dy = y[i] - p.y, dz = z[i] - p.z;
                cosine = (n.x * dx + n.y * dy + n.z * dz) *
                         lightcuts::detail::inverse_sqrt(dx * dx + dy * dy + dz * dz);
                above = h.x * dx + h.y * dy + h.z * dz;
            } else {
                cosine = n.x * x[i] + n.y * y[i] + n.z * z[i];
                above = h.x * x[i] + h.y * y[i] + h.z * z[i];
            }
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

LIGHTCUTS_VECTORIZED glm::vec3 ClusterLights::irradiance(const glm::vec3& corners, const glm::vec3& normal,
                                                         const glm::vec3& horizon) const {
    return irradiance_at<false>(corners, glm::vec3(0.0f), normal, horizon);
}

LIGHTCUTS_VECTORIZED glm::vec3 ClusterLights::irradiance_from_places(const glm::vec3& corners, const glm::vec3& from,
                                                                     const glm::vec3& normal,
                                                                     const glm::vec3& horizon) const {
    return irradiance_at<true>(corners, from, normal, horizon);
}

}  // namespace relight
