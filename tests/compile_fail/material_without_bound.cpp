// expect: a material needs upper_bound(offsets) const, which returns the spectrum that evaluate(to_light) does; or
#include <vector>

#include <lightcuts/lightcuts.hpp>

struct Chalk {
    float evaluate(const glm::vec3& to_light) const { return to_light.z > 0.0f ? to_light.z : 0.0f; }
};

int main() {
    const std::vector<lightcuts::OmniLight<float>> lights(3);
    const lightcuts::LightTree tree(lights);
    const lightcuts::Receiver receiver(glm::vec3(1.0f), Chalk{});
    return lightcuts::shade(tree, receiver).radiance > 0.0f ? 0 : 1;
}
