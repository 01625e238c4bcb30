#include <array>

#include <lightcuts/lightcuts.hpp>

int main() {
    const std::array<lightcuts::OmniLight<>, 3> lights{};
    const lightcuts::LightTree tree(lights);
}
