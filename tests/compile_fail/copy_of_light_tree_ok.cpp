#include <utility>
#include <vector>

#include <lightcuts/lightcuts.hpp>

struct Lamps {
    std::vector<lightcuts::OmniLight<>> lights;
    lightcuts::LightTree<lightcuts::OmniLight<>> tree{lights};
};

int main() {
    Lamps lamps;
    const Lamps others = std::move(lamps);
    return others.tree.empty() ? 0 : 1;
}
