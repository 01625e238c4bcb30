// Materials of one's own. All that is asked for is `evaluate`; what else one knows of a material makes cuts smaller.
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <lightcuts/lightcuts.hpp>
#include <lightcuts/material/capped.hpp>
#include <lightcuts/material/sum.hpp>

// Wax: light creeps around the edge, as long as the cosine is above -wrap. Grows with the cosine, so that its bound is
// its value at the largest cosine: `max_cosine` finds that over all lights in a box.
struct Wax {
    glm::vec3 normal;
    glm::vec3 albedo;
    float wrap;

    glm::vec3 evaluate(const glm::vec3& to_light) const { return at(glm::dot(normal, to_light)); }
    glm::vec3 upper_bound(const lightcuts::OffsetBox& box) const {
        const double most = lightcuts::max_cosine(glm::dvec3(normal), box);
        return at(static_cast<float>(most) + 1e-6f);  // the rounding of a dot product in float
    }

private:
    glm::vec3 at(float cosine) const {
        const float lit = std::fmax(0.0f, (cosine + wrap) / (1.0f + wrap));
        return albedo * (0.31830988f * lit * lit);
    }
};

// Drawn in five shades, each rounded down: never above Lambert's, which is all that `cosine_lobe` promises. From it the
// library forms bounds of cosine and distance together, the tightest there are.
struct Cartoon {
    glm::vec3 normal;
    glm::vec3 albedo;

    glm::vec3 evaluate(const glm::vec3& to_light) const {
        const float shade = std::floor(5.0f * std::fmax(0.0f, glm::dot(normal, to_light))) / 5.0f;
        return albedo * (0.31830988f * shade);
    }
    lightcuts::CosineLobe<glm::vec3> cosine_lobe() const { return {normal, albedo * 0.31830988f}; }
};

// Velvet, bright at the rim: how bright it gets over a box of lights is unknown.
struct Velvet {
    glm::vec3 normal;
    glm::vec3 to_eye;

    glm::vec3 evaluate(const glm::vec3& to_light) const {
        const float cosine = glm::dot(normal, to_light);
        if (!(cosine > 0.0f)) return glm::vec3(0.0f);
        const float half = glm::dot(normal, glm::normalize(to_light + to_eye));
        const float rim = 1.0f - half * half;
        return glm::vec3(0.5f, 0.1f, 0.2f) * (rim * rim * cosine);
    }
};

namespace {

bool check(const char* name, const auto& tree, const auto& material) {
    const lightcuts::Receiver point(glm::vec3(0.0f), material);
    const auto shaded = lightcuts::shade(tree, point);
    const auto exact = lightcuts::exhaustive(tree, point);
    const float error = std::fabs(shaded.radiance.r - exact.radiance.r);
    std::printf("%-18s %8.3f %11.3f %7.2f %% %7u\n", name, shaded.radiance.r, exact.radiance.r,
                100.0f * error / exact.radiance.r, shaded.cut_size);
    return error <= shaded.error_bound.r && error < 0.1f * exact.radiance.r;
}

}  // namespace

int main() {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> across(-10.0f, 10.0f), height(-3.0f, 5.0f);
    std::vector<lightcuts::OmniLight<>> lights(50'000);
    for (auto& light : lights) {
        const glm::vec3 at{across(random), across(random), height(random)};
        light.position = at * (1.0f + 1.0f / glm::length(at));  // none within a meter
        light.intensity = glm::vec3(1.0f);
    }
    const lightcuts::LightTree tree(lights);

    const glm::vec3 normal(0.0f, 0.0f, 1.0f), to_eye(0.6f, 0.0f, 0.8f), cream(0.8f, 0.7f, 0.5f);
    const Wax wax{normal, cream, 0.5f};
    const Cartoon cartoon{normal, cream};
    // A search over all directions found 0.157 of the color at most. The cap is part of the material from here on: one
    // that is too low would darken the picture, one that is too high makes the cuts larger than they need be.
    const lightcuts::Capped velvet{Velvet{normal, to_eye}, 0.17f * glm::vec3(0.5f, 0.1f, 0.2f)};

    std::printf("                   lightcut  exhaustive    off by     cut\n");
    bool good = check("wax (bound)", tree, wax);
    good = check("cartoon (lobe)", tree, cartoon) && good;
    good = check("velvet (cap)", tree, velvet) && good;
    good = check("wax + velvet", tree, lightcuts::Sum{wax, velvet}) && good;
    return good ? 0 : 1;
}
