#include "surfaces/lobe_sampling.hpp"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <lightcuts/core/basis.hpp>

namespace render {

namespace {

using lightcuts::around_z;
using lightcuts::Basis;
using std::numbers::pi;

}  // namespace

LobeSampler::LobeSampler(const SurfaceLobes& lobes, const glm::vec3& normal, const glm::vec3& to_viewer)
    : model_(lobes.model), shininess_(static_cast<double>(lobes.shininess)),
      normal_(glm::normalize(glm::dvec3(normal))), view_(glm::normalize(glm::dvec3(to_viewer))),
      diffuse_share_(mean(lobes.diffuse)) {
    if (model_ == SurfaceLobes::Model::phong) {
        mirror_ = glm::normalize(2.0 * glm::dot(normal_, view_) * normal_ - view_);
        gloss_share_ = mean(lobes.specular);
    }
    if (model_ == SurfaceLobes::Model::microfacet) {
        const auto grazing = static_cast<double>(schlick(static_cast<float>(glm::dot(normal_, view_))));
        gloss_share_ = mean(lobes.specular) * (1.0 - grazing) + static_cast<double>(lobes.grazing) * grazing;
    }
}

glm::dvec3 LobeSampler::diffuse(const glm::dvec2& u) const {
    return Basis(normal_).out(around_z(std::sqrt(1.0 - u.x), u.y));
}

glm::dvec3 LobeSampler::glossy(const glm::dvec2& u) const {
    if (model_ == SurfaceLobes::Model::phong) {
        return Basis(mirror_).out(around_z(std::pow(1.0 - u.x, 1.0 / (shininess_ + 1.0)), u.y));
    }
    // Visible normals of GGX, as a cap of the sphere [Dupuy and Benyoub 2023].
    const Basis frame(normal_);
    const auto stretched = [&](const glm::dvec3& v) {
        return glm::normalize(glm::dvec3(shininess_ * v.x, shininess_ * v.y, v.z));
    };
    const glm::dvec3 view = stretched(frame.in(view_));
    const glm::dvec3 half = stretched(around_z((1.0 - u.x) * (1.0 + view.z) - view.z, u.y) + view);
    const glm::dvec3 normal = frame.out(half);
    return glm::normalize(2.0 * glm::dot(normal, view_) * normal - view_);
}

double LobeSampler::density(const glm::dvec3& direction, double probability) const {
    const double cosine = glm::dot(normal_, direction);
    const double diffuse = cosine > 0.0 ? cosine / pi : 0.0;
    return probability * diffuse + (probability < 1.0 ? (1.0 - probability) * glossy_density(direction) : 0.0);
}

double LobeSampler::glossy_density(const glm::dvec3& direction) const {
    if (model_ == SurfaceLobes::Model::phong) {
        const double along = glm::dot(mirror_, direction);
        return along > 0.0 ? (shininess_ + 1.0) / (2.0 * pi) * std::pow(along, shininess_) : 0.0;
    }
    const glm::dvec3 half = glm::normalize(direction + view_);
    const glm::dvec3 across = glm::cross(normal_, half);
    const double alpha2 = shininess_ * shininess_, sine2 = glm::dot(across, across);
    const double q = sine2 + alpha2 * (1.0 - sine2);
    const double cosine = glm::dot(normal_, view_);
    const double root = std::sqrt(alpha2 + (1.0 - alpha2) * cosine * cosine);
    return alpha2 / (pi * q * q) / (2.0 * (cosine + root));
}

}  // namespace render
