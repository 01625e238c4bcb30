// A host that compiles without exceptions is told what is wrong before it ends.
#include <lightcuts/lightcuts.hpp>

int main() {
    std::vector<lightcuts::OmniLight<>> lights(2);
    lights[1].intensity = glm::vec3(-1.0f);
    const lightcuts::LightTree tree(lights);
    return 0;
}
