#include <vector>

#include <lightcuts/lightcuts.hpp>

struct Bulb {
    glm::vec3 position{0.0f};
    float intensity = 1.0f;
};

int main() {
    const std::vector<Bulb> bulbs(3);
    const lightcuts::LightTree tree(bulbs);
}
