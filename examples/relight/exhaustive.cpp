#include "exhaustive.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <vector>

#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>
#include <lightcuts/core/lanes.hpp>
#include <render/progress.hpp>
#include <render/rays/sky_rays.hpp>
#include <render/surfaces/surface_material.hpp>

#include "site_patches.hpp"

namespace relight {

namespace {

using render::SurfacePoint;

/// By direction, what a point makes of its light.
void reflect(const SurfacePoint& point, const Directions& directions, std::span<const glm::vec3> power,
             std::vector<glm::vec3>& reflected) {
    constexpr auto lanes = static_cast<std::size_t>(lightcuts::lane_count);
    const render::SurfaceMaterial material(point);
    reflected.resize(directions.size());
    for (std::size_t begin = 0; begin < directions.size(); begin += lanes) {
        const std::size_t count = std::min(lanes, directions.size() - begin);
        lightcuts::LaneVectors to_lights;
        for (std::size_t i = 0; i < count; ++i) to_lights.set(static_cast<int>(i), directions.leaves[begin + i]);
        lightcuts::detail::repeat_last(to_lights, static_cast<int>(count));
        lightcuts::LaneSpectra<glm::vec3> values;
        material.evaluate_many(to_lights, static_cast<int>(count), values);
        for (std::size_t i = 0; i < count; ++i) reflected[begin + i] = values[i] * power[begin + i];
    }
}

class PixelSum {
public:
    PixelSum(const Directions& directions, const render::RayScene& rays) : directions_(directions), rays_(rays) {}

    glm::vec3 operator()(const SurfacePoint& point, std::span<const glm::vec3> power) {
        reflect(point, directions_, power, reflected_);
        const glm::vec3 behind = 2.0f * point.position - point.ray_origin;
        const render::SurfaceMaterial material(point);
        glm::dvec3 sum(0.0);
        for (const bool is_behind : {false, true}) {
            lit_.clear();
            asked_.clear();
            for (std::size_t i = 0; i < directions_.size(); ++i) {
                if (reflected_[i] == glm::vec3(0.0f)) continue;
                if (material.is_behind(directions_.leaves[i]) != is_behind) continue;
                lit_.push_back(reflected_[i]);
                asked_.push_back(directions_.leaves[i]);
            }
            answers_.resize(lit_.size());
            sky_.look(rays_, is_behind ? behind : point.ray_origin, asked_, answers_);
            for (std::size_t k = 0; k < lit_.size(); ++k) sum += glm::dvec3(lit_[k]) * static_cast<double>(answers_[k]);
        }
        return glm::vec3(sum);
    }

private:
    const Directions& directions_;
    const render::RayScene& rays_;
    render::SkyRays sky_;
    std::vector<glm::vec3> reflected_, lit_, asked_;
    std::vector<float> answers_;
};

class VertexSum {
public:
    VertexSum(const Directions& directions, const render::RayScene& rays, Sides sides)
        : directions_(directions), sky_(directions, rays, sides) {}

    glm::vec3 operator()(const SurfacePoint& point, const Sites& sites, std::span<const glm::vec3> power) {
        if (!is_any_ || triangle_ != point.triangle) {
            for (std::size_t k = 0; k < 3; ++k) {
                sky_.look(sites.sites[sites.of_triangle[point.triangle][static_cast<int>(k)]]);
                const std::span<const float> shares = sky_.shares();
                corners_[k].assign(shares.begin(), shares.end());
            }
            triangle_ = point.triangle;
            is_any_ = true;
        }
        reflect(point, directions_, power, reflected_);
        const float a = 1.0f - point.u - point.v;
        glm::dvec3 sum(0.0);
        for (std::size_t i = 0; i < directions_.size(); ++i) {
            const float visible = a * corners_[0][i] + point.u * corners_[1][i] + point.v * corners_[2][i];
            sum += glm::dvec3(reflected_[i]) * static_cast<double>(visible);
        }
        return glm::vec3(sum);
    }

private:
    const Directions& directions_;
    SiteSky sky_;
    bool is_any_ = false;
    std::uint32_t triangle_ = 0;
    std::array<std::vector<float>, 3> corners_;
    std::vector<glm::vec3> reflected_;
};

/// By patch, how much of its light arrives at `point`, as its solid angle: from the point, or from the corners of its
/// triangle, interpolated.
class PatchSum {
public:
    PatchSum(const Patches& patches, std::span<const glm::vec3> ends, const render::RayScene& rays, Sides sides)
        : patches_(patches), ends_(ends), rays_(rays), view_(patches, ends, rays, sides) {}

    glm::vec3 operator()(const SurfacePoint& point, const Sites& sites, std::span<const glm::vec3> light, Truth truth) {
        if (truth == Truth::vertices) {
            look_from_corners(point, sites);
        } else {
            look_from(point, truth == Truth::pixels);
        }
        const render::SurfaceMaterial material(point);
        glm::dvec3 sum(0.0);
        for (std::size_t i = 0; i < patches_.size(); ++i) {
            if (arriving_[i] == 0.0f || light[i] == glm::vec3(0.0f)) continue;
            const glm::vec3 way = glm::normalize(patches_[i].position - point.position);
            sum += glm::dvec3(material.evaluate(way) * light[i]) * static_cast<double>(arriving_[i]);
        }
        return glm::vec3(sum);
    }

private:
    void look_from(const SurfacePoint& point, bool traces) {
        arriving_.resize(patches_.size());
        const float clearance = 2.0f * glm::distance(point.ray_origin, point.position);
        for (std::size_t i = 0; i < patches_.size(); ++i) {
            arriving_[i] = patches_.solid_angle(i, point.position, clearance);
        }
        if (!traces) return;
        const render::SurfaceMaterial material(point);
        const glm::vec3 behind = 2.0f * point.position - point.ray_origin;
        for (std::size_t i = 0; i < patches_.size(); ++i) {
            if (arriving_[i] == 0.0f) continue;
            const bool is_behind = material.is_behind(patches_[i].position - point.position);
            const glm::vec3 passed = rays_.to_point(is_behind ? behind : point.ray_origin, ends_[i]);
            arriving_[i] *= (passed.x + passed.y + passed.z) / 3.0f;
        }
    }
    void look_from_corners(const SurfacePoint& point, const Sites& sites) {
        if (!is_any_ || triangle_ != point.triangle) {
            for (std::size_t k = 0; k < 3; ++k) {
                view_.look(sites.sites[sites.of_triangle[point.triangle][static_cast<int>(k)]]);
                corners_[k].assign(view_.shares().begin(), view_.shares().end());
            }
            triangle_ = point.triangle;
            is_any_ = true;
        }
        const glm::vec3 w = corner_weights(point);
        arriving_.resize(patches_.size());
        for (std::size_t i = 0; i < patches_.size(); ++i) {
            arriving_[i] = w.x * corners_[0][i] + w.y * corners_[1][i] + w.z * corners_[2][i];
        }
    }

    const Patches& patches_;
    std::span<const glm::vec3> ends_;
    const render::RayScene& rays_;
    SitePatches view_;
    bool is_any_ = false;
    std::uint32_t triangle_ = 0;
    std::array<std::vector<float>, 3> corners_;
    std::vector<float> arriving_;
};

/// Points of one triangle one after another, which look from the same corners.
std::vector<std::uint32_t> by_triangle(const SeenPoints& seen) {
    std::vector<std::uint32_t> order(seen.points.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return seen.points[a].triangle < seen.points[b].triangle;
    });
    return order;
}

}  // namespace

void shade_exhaustively(const SeenPoints& seen, const Sites& sites, const Directions& directions,
                        std::span<const glm::vec3> power, const render::RayScene& rays, Sides sides, Truth truth,
                        bool shown, std::span<glm::vec3> radiance) {
    const std::vector<std::uint32_t> order = by_triangle(seen);
    struct Scratch {
        PixelSum pixels;
        VertexSum vertices;
        std::vector<glm::vec3> reflected;
    };
    tbb::enumerable_thread_specific<Scratch> scratches([&] {
        return Scratch{PixelSum(directions, rays), VertexSum(directions, rays, sides), {}};
    });
    render::Progress progress(order.size(), shown);
    tbb::parallel_for(std::size_t{0}, order.size(), [&](std::size_t k) {
        const SurfacePoint& point = seen.points[order[k]];
        Scratch& scratch = scratches.local();
        glm::vec3& sum = radiance[order[k]];
        switch (truth) {
            case Truth::pixels: sum = scratch.pixels(point, power); break;
            case Truth::vertices: {
                const bool is_dark = sides == Sides::front && shows_back(sites, point);
                sum = is_dark ? glm::vec3(0.0f) : scratch.vertices(point, sites, power);
                break;
            }
            case Truth::none: {
                reflect(point, directions, power, scratch.reflected);
                glm::dvec3 total(0.0);
                for (const glm::vec3& r : scratch.reflected) total += glm::dvec3(r);
                sum = glm::vec3(total);
                break;
            }
        }
        progress.step();
    });
}

void add_bounce_exhaustively(const SeenPoints& seen, const Sites& sites, const Patches& patches,
                             const render::Scene& scene, std::span<const glm::vec3> patch_radiance,
                             const render::RayScene& rays, Sides sides, Truth truth, bool shown,
                             std::span<glm::vec3> radiance) {
    const std::vector<std::uint32_t> order = by_triangle(seen);
    const std::vector<glm::vec3> ends = ray_ends(patches, scene);
    tbb::enumerable_thread_specific<PatchSum> sums([&] { return PatchSum(patches, ends, rays, sides); });
    render::Progress progress(order.size(), shown);
    tbb::parallel_for(std::size_t{0}, order.size(), [&](std::size_t k) {
        const SurfacePoint& point = seen.points[order[k]];
        const bool is_dark = truth == Truth::vertices && sides == Sides::front && shows_back(sites, point);
        if (!is_dark) radiance[order[k]] += sums.local()(point, sites, patch_radiance, truth);
        progress.step();
    });
}

}  // namespace relight
