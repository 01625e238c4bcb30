#include "relit_shader.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <glm/geometric.hpp>
#include <lightcuts/core/lanes.hpp>
#include <lightcuts/piecewise/merge.hpp>
#include <render/surfaces/surface_material.hpp>

#include "cluster_lights.hpp"

namespace relight {

namespace {

using render::SurfacePoint;

bool is_glossy(const SurfacePoint& point) { return point.model != SurfacePoint::Model::lambert; }

/// About where a lobe has fallen to half, from its middle: radians.
float lobe_width(const SurfacePoint& point) {
    // The mirror direction turns by twice the angle of a facet.
    if (point.model == SurfacePoint::Model::microfacet) return 2.0f * point.shininess;
    return std::sqrt(2.0f / (point.shininess + 2.0f));
}

/// The same point without its diffuse parts.
SurfacePoint lobe_alone(SurfacePoint point) {
    point.diffuse = glm::vec3(0.0f);
    point.transmitted = glm::vec3(0.0f);
    return point;
}

glm::vec3 corner_weights(const SurfacePoint& point) { return {1.0f - point.u - point.v, point.u, point.v}; }

/// Sums up light that arrives from single directions, eight at a time.
class LitSum {
public:
    explicit LitSum(const render::SurfaceMaterial& material) : material_(material) {}

    void add(const glm::vec3& direction, const glm::vec3& power) {
        directions_.set(count_, direction);
        powers_[count_] = power;
        if (++count_ == lightcuts::lane_count) flush();
    }
    glm::vec3 result() {
        if (count_ > 0) flush();
        return sum_;
    }
    std::uint64_t evaluated() const { return evaluated_; }

private:
    void flush() {
        lightcuts::detail::repeat_last(directions_, count_);
        lightcuts::LaneSpectra<glm::vec3> values;
        material_.evaluate_many(directions_, count_, values);
        for (int i = 0; i < count_; ++i) sum_ += powers_[i] * values[static_cast<std::size_t>(i)];
        evaluated_ += static_cast<std::uint64_t>(count_);
        count_ = 0;
    }

    const render::SurfaceMaterial& material_;
    lightcuts::LaneVectors directions_;
    glm::vec3 powers_[lightcuts::lane_count];
    int count_ = 0;
    std::uint64_t evaluated_ = 0;
    glm::vec3 sum_{0.0f};
};

}  // namespace

/// What a thread keeps between triangles.
struct RelitShader::Scratch {
    ClusterLights lights;
    std::vector<std::uint32_t> open;
    RelitStatistics statistics;
};

RelitShader::RelitShader(const RelightFile& file, const Sites& sites, const SeenPoints& seen)
    : sites_(sites), seen_(seen), sides_(file.preparation().sides), order_(seen.points.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    std::stable_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
        return seen.points[a].triangle < seen.points[b].triangle;
    });
    constexpr auto unused = static_cast<std::uint32_t>(-1);
    cut_of_.assign(sites.sites.size(), unused);
    std::vector<std::uint32_t> used;
    for (std::size_t i = 0; i < order_.size(); ++i) {
        const std::uint32_t triangle = seen.points[order_[i]].triangle;
        if (i > 0 && seen.points[order_[i - 1]].triangle == triangle) continue;
        begins_.push_back(i);
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t site = sites.of_triangle[triangle][k];
            if (cut_of_[site] != unused) continue;
            cut_of_[site] = static_cast<std::uint32_t>(used.size());
            used.push_back(site);
        }
    }
    begins_.push_back(order_.size());
    cuts_.resize(used.size());
    tbb::parallel_for(std::size_t{0}, used.size(), [&](std::size_t i) { file.read(used[i], cuts_[i]); });
}

double RelitShader::mean_cut_size() const {
    double sum = 0.0;
    for (const auto& cut : cuts_) sum += static_cast<double>(cut.size());
    return cuts_.empty() ? 0.0 : sum / static_cast<double>(cuts_.size());
}

RelitStatistics RelitShader::shade(const Illumination& light, const RelitOptions& options,
                                   std::span<glm::vec3> radiance) const {
    tbb::enumerable_thread_specific<Scratch> scratches;
    tbb::parallel_for(std::size_t{0}, begins_.size() - 1, [&](std::size_t group) {
        Scratch& scratch = scratches.local();
        merge(std::span(order_).subspan(begins_[group], begins_[group + 1] - begins_[group]), light, scratch);
        ++scratch.statistics.triangles;
        scratch.statistics.nodes += scratch.lights.node_count();
        scratch.statistics.clusters += scratch.lights.size() * (begins_[group + 1] - begins_[group]);
        for (std::size_t i = begins_[group]; i < begins_[group + 1]; ++i) {
            const SurfacePoint& point = seen_.points[order_[i]];
            const bool is_dark = sides_ == Sides::front && shows_back(sites_, point);
            radiance[order_[i]] = is_dark ? glm::vec3(0.0f) : shade(point, light, options, scratch);
            scratch.statistics.backs += is_dark ? 1 : 0;
        }
    });
    RelitStatistics sum;
    for (const Scratch& scratch : scratches) {
        sum.triangles += scratch.statistics.triangles;
        sum.nodes += scratch.statistics.nodes;
        sum.clusters += scratch.statistics.clusters;
        sum.directions += scratch.statistics.directions;
        sum.glossy += scratch.statistics.glossy;
        sum.backs += scratch.statistics.backs;
    }
    return sum;
}

void RelitShader::merge(std::span<const std::uint32_t> points, const Illumination& light, Scratch& scratch) const {
    const SurfacePoint& first = seen_.points[points.front()];
    // Of a triangle that is seen from one side, and lets nothing through, what is below it lights none of its points.
    const bool has_horizon = std::all_of(points.begin(), points.end(), [&](std::uint32_t i) {
        const SurfacePoint& point = seen_.points[i];
        return point.transmitted == glm::vec3(0.0f) && glm::dot(point.geometric_normal, first.geometric_normal) > 0.0f;
    });
    const glm::vec3 up = has_horizon ? first.geometric_normal : glm::vec3(0.0f);
    const glm::uvec3 corners = sites_.of_triangle[first.triangle];
    ClusterLights& lights = scratch.lights;
    lights.clear();
    // Where the illumination's current piece ends, and how wide it is: nodes below one piece are one cluster.
    const std::span<const lightcuts::Piece> pieces = light.cut().pieces();
    std::size_t piece = 0;
    std::uint32_t leaf_end = 0;
    float radius = 0.0f;
    lightcuts::merge(
        [&](std::uint32_t node, std::uint32_t leaves, float a, float b, float c, const glm::vec3&) {
            leaf_end += leaves;
            const Illumination::Light& at = light.light(node);
            radius = std::max(radius, at.radius);
            const bool is_dark = a == 0.0f && b == 0.0f && c == 0.0f;
            if (!is_dark && !(glm::dot(up, at.direction) < -at.radius)) lights.add(node, at, {a, b, c});
            if (leaf_end < pieces[piece].leaf_end()) return;
            radius = std::max(radius, light.light(pieces[piece].node()).radius);
            lights.end_cluster(radius);
            radius = 0.0f;
            while (piece < pieces.size() && pieces[piece].leaf_end() <= leaf_end) ++piece;
        },
        cuts_[cut_of_[corners.x]], cuts_[cut_of_[corners.y]], cuts_[cut_of_[corners.z]], light.cut());
    scratch.lights.finish();
}

glm::vec3 RelitShader::shade(const SurfacePoint& point, const Illumination& light, const RelitOptions& options,
                             Scratch& scratch) const {
    const ClusterLights& lights = scratch.lights;
    const glm::vec3 corners = corner_weights(point);
    const glm::vec3 n = point.shading_normal, horizon = point.geometric_normal;
    glm::vec3 diffuse(0.0f);
    if (point.diffuse != glm::vec3(0.0f)) diffuse += point.diffuse * lights.irradiance(corners, n, horizon);
    if (point.transmitted != glm::vec3(0.0f)) {
        diffuse += point.transmitted * lights.irradiance(corners, -n, -horizon);
    }
    diffuse *= static_cast<float>(std::numbers::inv_pi);
    if (!is_glossy(point)) return diffuse;
    ++scratch.statistics.glossy;
    const lightcuts::ClusterTree& tree = light.directions().tree;
    const render::SurfaceMaterial material(lobe_alone(point));
    LitSum sum(material);
    const glm::vec3 mirrored = 2.0f * glm::dot(n, point.to_viewer) * n - point.to_viewer;
    const float width = lobe_width(point);
    // The lobe varies over a cluster that is wide and near its middle.
    const auto is_coarse = [&](float radius, const glm::vec3& direction) {
        if (!(radius > options.gloss_detail * width)) return false;
        const float near = radius + 3.0f * width;
        return 2.0f - 2.0f * glm::dot(mirrored, direction) < near * near;
    };
    for (std::size_t i = 0; i < lights.size(); ++i) {
        if (!is_coarse(lights.radius(i), lights.direction(i))) {
            sum.add(lights.direction(i), lights.power(i, corners));
            continue;
        }
        for (std::size_t k = lights.begin(i); k < lights.end(i); ++k) {
            const float visible = glm::dot(lights.node(k).visible, corners);
            scratch.open.assign(1, lights.node(k).node);
            while (!scratch.open.empty()) {
                const std::uint32_t node = scratch.open.back();
                scratch.open.pop_back();
                const Illumination::Light& at = light.light(node);
                if (!tree.is_leaf(node) && is_coarse(at.radius, at.direction)) {
                    scratch.open.push_back(tree.left(node));
                    scratch.open.push_back(tree.right(node));
                } else {
                    sum.add(at.direction, at.power * visible);
                }
            }
        }
    }
    const glm::vec3 result = sum.result();
    scratch.statistics.directions += sum.evaluated();
    return diffuse + result;
}

}  // namespace relight
