// expect: a light with falloff(d) needs falloff_bound(d_min): static, or on what its envelope() returns
#include <vector>

#include <lightcuts/lightcuts.hpp>

struct Lamp {
    glm::vec3 position{0.0f};
    float intensity = 1.0f;
    float falloff(float distance) const { return 1.0f / (1.0f + distance); }
};

int main() {
    const std::vector<Lamp> lamps(3);
    const lightcuts::LightTree tree(lamps);
    const lightcuts::Receiver receiver(glm::vec3(1.0f), lightcuts::Lambert<float>{{0.0f, 0.0f, 1.0f}, 0.5f});
    return lightcuts::shade(tree, receiver).radiance > 0.0f ? 0 : 1;
}
