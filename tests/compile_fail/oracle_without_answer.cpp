// expect: an oracle needs operator()(receiver, light) const, which returns a bool, a fraction or a spectrum
#include <vector>

#include <lightcuts/lightcuts.hpp>

struct Walls {
    template <class R, class L>
    bool blocked(const R&, const L&) const {
        return true;
    }
};

int main() {
    const std::vector<lightcuts::OmniLight<float>> lights(3);
    const lightcuts::LightTree tree(lights);
    const lightcuts::Receiver receiver(glm::vec3(1.0f), lightcuts::Lambert<float>{{0.0f, 0.0f, 1.0f}, 0.5f});
    lightcuts::shade(tree, receiver, Walls{});
}
