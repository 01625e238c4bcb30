#include <vector>

#include <lightcuts/lightcuts.hpp>

struct Torch {
    glm::vec3 position;
    glm::vec3 axis;
    float intensity;
};

int main() {
    const std::vector<Torch> torches(3);
    const lightcuts::LightTree tree(torches);
}
