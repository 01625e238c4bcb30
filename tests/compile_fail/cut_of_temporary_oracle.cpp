// expect: deleted
#include <vector>

#include <lightcuts/lightcuts.hpp>

int main() {
    const std::vector<lightcuts::OmniLight<float>> lights(3);
    const lightcuts::LightTree tree(lights);
    const lightcuts::Receiver receiver(glm::vec3(1.0f), lightcuts::Lambert<float>{{0.0f, 0.0f, 1.0f}, 0.5f});
    const float door = 0.5f;
    lightcuts::Lightcut cut(tree, receiver, [door](const auto&, const auto& light) { return light.position.x < door; });
    cut.step();
}
