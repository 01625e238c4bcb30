#include <vector>

#include <lightcuts/lightcuts.hpp>

struct Lamp {
    glm::vec3 position{0.0f};
    glm::vec3 axis{0.0f, 0.0f, 1.0f};
    float intensity = 1.0f;
    float emission(float cosine) const { return cosine > 0.5f ? 1.0f : 0.0f; }
};

int main() {
    const std::vector<Lamp> lamps(3);
    const lightcuts::LightTree tree(lamps);
}
