// expect: the lights of a tree stand side by side
#include <deque>

#include <lightcuts/lightcuts.hpp>

int main() {
    const std::deque<lightcuts::OmniLight<>> lights(3);
    const lightcuts::LightTree tree(lights);
}
