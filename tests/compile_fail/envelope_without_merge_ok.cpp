#include <vector>

#include <lightcuts/lightcuts.hpp>

struct Reach {
    float constant = 1.0f;
    float falloff_bound(float distance) const { return 1.0f / (constant + distance); }
    friend Reach merge(Reach a, Reach b) { return {a.constant < b.constant ? a.constant : b.constant}; }
};

struct Lamp {
    glm::vec3 position{0.0f};
    float intensity = 1.0f;
    Reach reach;
    float falloff(float distance) const { return 1.0f / (reach.constant + distance); }
    Reach envelope() const { return reach; }
};

int main() {
    const std::vector<Lamp> lamps(3);
    const lightcuts::LightTree tree(lamps);
    const lightcuts::Receiver receiver(glm::vec3(1.0f), lightcuts::Lambert<float>{{0.0f, 0.0f, 1.0f}, 0.5f});
    return lightcuts::shade(tree, receiver).radiance > 0.0f ? 0 : 1;
}
