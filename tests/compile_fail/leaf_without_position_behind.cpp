// expect: a scene with leaves needs both: diffuse_transmittance(hit) const, which returns the lights' Spectrum, and
#include <optional>
#include <vector>

#include <lightcuts/lightcuts.hpp>
#include <lightcuts/source/virtual_lights.hpp>

struct Blade {
    struct Hit {
        glm::vec3 position, normal;
    };
    std::optional<Hit> intersect(const glm::vec3&, const glm::vec3&) const { return std::nullopt; }
    float diffuse_albedo(const Hit&) const { return 0.5f; }
    float diffuse_transmittance(const Hit&) const { return 0.3f; }
    lightcuts::ScatteredParticle<float> scatter(const Hit&, const glm::vec3&, const glm::vec3&) const { return {}; }
};

int main() {
    const std::vector<lightcuts::OmniLight<float>> lights(3);
    lightcuts::virtual_lights(Blade{}, lightcuts::ParticleSources(lights));
}
