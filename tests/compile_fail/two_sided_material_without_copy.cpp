// expect: an oracle that is asked about receivers sees a copy of a two-sided one: let its material be copyable, or
#include <utility>
#include <vector>

#include <lightcuts/lightcuts.hpp>

struct Leaf {
    Leaf() = default;
    Leaf(Leaf&&) = default;
    float evaluate(const glm::vec3&) const { return 0.1f; }
    float upper_bound(const lightcuts::OffsetBox&) const { return 0.1f; }
    bool is_behind(const glm::vec3& to_light) const { return to_light.z < 0.0f; }
};

struct Fog {
    template <class R, class L>
    float operator()(const R&, const L&) const {
        return 0.5f;
    }
};

int main() {
    const std::vector<lightcuts::OmniLight<float>> lights(3);
    const lightcuts::LightTree tree(lights);
    Leaf leaf;
    const lightcuts::Receiver<Leaf> receiver(glm::vec3(1.0f), std::move(leaf));
    lightcuts::exhaustive(tree, receiver, Fog{});
}
