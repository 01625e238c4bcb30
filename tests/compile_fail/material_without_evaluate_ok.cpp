#include <vector>

#include <lightcuts/lightcuts.hpp>

struct Chalk {
    float evaluate(const glm::vec3& to_light) const { return to_light.z > 0.0f ? to_light.z : 0.0f; }
    float upper_bound(const lightcuts::OffsetBox&) const { return 1.0f; }
};

int main() {
    const std::vector<lightcuts::OmniLight<float>> lights(3);
    const lightcuts::LightTree tree(lights);
    const lightcuts::Receiver receiver(glm::vec3(1.0f), Chalk{});
    return lightcuts::shade(tree, receiver).radiance > 0.0f ? 0 : 1;
}
