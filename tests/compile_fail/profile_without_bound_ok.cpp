#include <vector>

#include <lightcuts/lightcuts.hpp>

struct Lamp {
    glm::vec3 position{0.0f};
    glm::vec3 axis{0.0f, 0.0f, 1.0f};
    float intensity = 1.0f;
    float emission(float cosine) const { return cosine > 0.5f ? 1.0f : 0.0f; }
    static float emission_bound(float, float cos_max) { return cos_max > 0.5f ? 1.0f : 0.0f; }
};

int main() {
    const std::vector<Lamp> lamps(3);
    const lightcuts::LightTree tree(lamps);
    const lightcuts::Receiver receiver(glm::vec3(1.0f), lightcuts::Lambert<float>{{0.0f, 0.0f, 1.0f}, 0.5f});
    return lightcuts::shade(tree, receiver).radiance > 0.0f ? 0 : 1;
}
