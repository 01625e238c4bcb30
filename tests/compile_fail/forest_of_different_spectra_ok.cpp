#include <vector>

#include <lightcuts/lightcuts.hpp>

int main() {
    const std::vector<lightcuts::OmniLight<glm::vec3>> colored(3);
    const std::vector<lightcuts::DistantLight<glm::vec3>> gray(3);
    const lightcuts::LightTree a(colored);
    const lightcuts::LightTree b(gray);
    const lightcuts::LightForest forest(a, b);
    return forest.root_count() > 0 ? 1 : 0;
}
