// expect: a material's evaluate(to_light) needs to return the spectrum in which the lights state their intensity
#include <vector>

#include <lightcuts/lightcuts.hpp>

int main() {
    const std::vector<lightcuts::OmniLight<glm::vec3>> lights(3);
    const lightcuts::LightTree tree(lights);
    const lightcuts::Lambert<float> chalk{{0.0f, 0.0f, 1.0f}, 0.5f};
    const lightcuts::Receiver receiver(glm::vec3(1.0f), chalk);
    lightcuts::shade(tree, receiver);
}
