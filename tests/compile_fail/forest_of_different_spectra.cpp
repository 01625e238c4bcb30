// expect: all lights of a forest need the same spectrum
#include <vector>

#include <lightcuts/lightcuts.hpp>

int main() {
    const std::vector<lightcuts::OmniLight<glm::vec3>> coloured(3);
    const std::vector<lightcuts::DistantLight<float>> grey(3);
    const lightcuts::LightTree a(coloured);
    const lightcuts::LightTree b(grey);
    const lightcuts::LightForest forest(a, b);
    return forest.root_count() > 0 ? 1 : 0;
}
