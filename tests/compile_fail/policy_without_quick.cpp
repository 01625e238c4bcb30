// expect: a bound policy needs quick(bound, cluster, receivers) const, which returns the lights'
#include <vector>

#include <lightcuts/lightcuts.hpp>

struct Guess {
    static constexpr bool two_stages = false;
};

int main() {
    const std::vector<lightcuts::OmniLight<float>> lights(3);
    const lightcuts::LightTree tree(lights);
    const lightcuts::Receiver receiver(glm::vec3(1.0f), lightcuts::Lambert<float>{{0.0f, 0.0f, 1.0f}, 0.5f});
    lightcuts::shade(tree, receiver, lightcuts::AlwaysVisible{}, {}, Guess{});
}
