#include <vector>

#include <lightcuts/lightcuts.hpp>

int main() {
    const std::vector<lightcuts::OmniLight<glm::vec3>> lights(3);
    const lightcuts::LightTree tree(lights);
    const lightcuts::Lambert<glm::vec3> chalk{{0.0f, 0.0f, 1.0f}, glm::vec3(0.5f)};
    const lightcuts::Receiver receiver(glm::vec3(1.0f), chalk);
    lightcuts::shade(tree, receiver);
}
