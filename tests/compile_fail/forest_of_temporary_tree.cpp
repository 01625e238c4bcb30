// expect: deleted
#include <vector>

#include <lightcuts/lightcuts.hpp>

int main() {
    const std::vector<lightcuts::OmniLight<>> bulbs(3);
    const std::vector<lightcuts::DistantLight<>> suns;
    const lightcuts::LightTree tree(bulbs);
    const lightcuts::LightForest<lightcuts::OmniLight<>, lightcuts::DistantLight<>> forest(
        tree, lightcuts::LightTree<lightcuts::DistantLight<>>(suns));
}
