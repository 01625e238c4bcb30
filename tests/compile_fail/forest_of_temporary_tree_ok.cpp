#include <vector>

#include <lightcuts/lightcuts.hpp>

int main() {
    const std::vector<lightcuts::OmniLight<>> bulbs(3);
    const std::vector<lightcuts::DistantLight<>> suns;
    const lightcuts::LightTree tree(bulbs);
    const lightcuts::LightTree<lightcuts::DistantLight<>> far(suns);
    const lightcuts::LightForest forest(tree, far);
}
