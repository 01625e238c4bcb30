#include <optional>
#include <vector>

#include <lightcuts/lightcuts.hpp>
#include <lightcuts/source/virtual_lights.hpp>

struct Mist {
    struct Hit {
        glm::vec3 position, normal;
    };
    std::optional<Hit> intersect(const glm::vec3&, const glm::vec3&) const { return std::nullopt; }
    float diffuse_albedo(const Hit&) const { return 0.5f; }
    lightcuts::ScatteredParticle<float> scatter(const Hit&, const glm::vec3&, const glm::vec3&) const { return {}; }
    double free_flight(const glm::vec3&, const glm::vec3&, double) const { return 1.0; }
    lightcuts::MediumScattering<float> scattering_at(const glm::vec3&) const { return {0.5f, 0.0f}; }
};

int main() {
    const std::vector<lightcuts::OmniLight<float>> lights(3);
    lightcuts::virtual_lights(Mist{}, lightcuts::ParticleSources(lights));
}
