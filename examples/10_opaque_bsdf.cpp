// A BSDF of an integrator that offers its values and nothing else. Bounded by a material of the library that is
// nowhere below it, it needs cuts as small as that one's; cut off at a stated cap, the whole cut.
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <lightcuts/lightcuts.hpp>

namespace theirs {

// Coated plaster: f(view, light) without the cosine, as integrators have it.
struct Bsdf {
    glm::vec3 normal;
    glm::vec3 albedo;
    float alpha;  // roughness, squared

    glm::vec3 f(const glm::vec3& wo, const glm::vec3& wi) const {
        const float o = glm::dot(normal, wo), i = glm::dot(normal, wi);
        if (!(o > 0.0f && i > 0.0f)) return glm::vec3(0.0f);
        const glm::vec3 h = glm::normalize(wo + wi);
        const float nh = glm::dot(normal, h), fresnel = 0.04f + 0.96f * std::pow(1.0f - glm::dot(wo, h), 5.0f);
        const float a2 = alpha * alpha, spread = nh * nh * (a2 - 1.0f) + 1.0f;
        const float d = a2 / (3.14159265f * spread * spread);
        const float g = 2.0f * o * i /
                        (o * std::sqrt(a2 + (1.0f - a2) * i * i) + i * std::sqrt(a2 + (1.0f - a2) * o * o));
        return albedo * ((1.0f - fresnel) * 0.31830988f) + glm::vec3(fresnel * d * g / (4.0f * o * i));
    }
};

}  // namespace theirs

// What the library asks of it at one receiver: BRDF x cosine towards one viewer.
struct Seen {
    const theirs::Bsdf* bsdf;
    glm::vec3 to_viewer;

    glm::vec3 evaluate(const glm::vec3& to_light) const {
        return bsdf->f(to_viewer, to_light) * std::fmax(0.0f, glm::dot(bsdf->normal, to_light));
    }
};

// The same lobes without the loss of light under the coat, so nowhere below; 1 % more for the rounding of theirs.
auto bounded(const theirs::Bsdf& bsdf, const glm::vec3& to_viewer) {
    const lightcuts::Lambert diffuse{bsdf.normal, 1.01f * bsdf.albedo};
    const lightcuts::Ggx coat{bsdf.normal, to_viewer, glm::vec3(0.0404f), bsdf.alpha, 1.01f};
    return lightcuts::BoundedBy{Seen{&bsdf, to_viewer}, lightcuts::Sum{diffuse, coat}};
}

int main() {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> across(-10.0f, 10.0f), height(2.0f, 6.0f);
    std::vector<lightcuts::OmniLight<>> lights(50'000);
    for (auto& light : lights) {
        light.position = {across(random), across(random), height(random)};
        light.intensity = glm::vec3(1.0f);
    }
    const lightcuts::LightTree tree(lights);

    const theirs::Bsdf bsdf{{0.0f, 0.0f, 1.0f}, {0.6f, 0.5f, 0.4f}, 0.15f};
    const glm::vec3 to_viewer(0.6f, 0.0f, 0.8f);
    const lightcuts::Receiver by_material(glm::vec3(0.0f), bounded(bsdf, to_viewer));
    // The largest value found by a search is about 0.9 / sr: a cap of 1.
    const lightcuts::Receiver by_cap(glm::vec3(0.0f), lightcuts::Capped{Seen{&bsdf, to_viewer}, glm::vec3(1.0f)});

    const auto exact = lightcuts::exhaustive(tree, by_material);
    const auto small = lightcuts::shade(tree, by_material), large = lightcuts::shade(tree, by_cap);
    const auto error = [&](const auto& result) { return std::fabs(result.radiance.r / exact.radiance.r - 1.0f); };
    std::printf("bounded by   cut   off by\n");
    std::printf("a material %5u %6.2f %%\n", small.cut_size, 100.0f * error(small));
    std::printf("a cap      %5u %6.2f %%\n", large.cut_size, 100.0f * error(large));
    return error(small) < 0.05f && error(large) < 0.05f && 2 * small.cut_size < large.cut_size ? 0 : 1;
}
