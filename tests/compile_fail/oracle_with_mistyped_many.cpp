// An oracle that answers about one light, and means to about many, with answers of the wrong type.
// expect: this oracle's many cannot be called, so it would be asked one light at a time
#include <span>
#include <vector>

#include <lightcuts/lightcuts.hpp>

struct Shadows {
    bool operator()(const auto&, const auto&) const { return true; }
    void many(std::span<const lightcuts::VisibilityQuery>, std::span<double>) const {}
};

void shade(const std::vector<lightcuts::OmniLight<>>& lights) {
    const lightcuts::LightTree tree(lights);
    const lightcuts::Receiver receiver(glm::vec3(0.0f), lightcuts::Lambert{glm::vec3(0, 0, 1), glm::vec3(0.5f)});
    lightcuts::shade(tree, receiver, Shadows{});
}
