// expect: a light needs intensity(): a float, a glm::vec3 or another Spectrum; a member, or a function of
#include <vector>

#include <lightcuts/lightcuts.hpp>

struct Bulb {
    glm::vec3 position{0.0f};
    glm::vec3 power{1.0f};
};

int main() {
    const std::vector<Bulb> bulbs(3);
    const lightcuts::LightTree tree(bulbs);
}
