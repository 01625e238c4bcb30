#include <vector>

#include <lightcuts/lightcuts.hpp>

std::vector<lightcuts::OmniLight<>> lights() { return std::vector<lightcuts::OmniLight<>>(3); }

int main() {
    const std::vector<lightcuts::OmniLight<>> kept = lights();
    const lightcuts::LightTree tree(kept);
}
