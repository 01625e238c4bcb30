// Surfaces of several kinds in one scene: a material around a std::variant. Each kind is bounded in its own best way,
// and the terms of eight lights are found at once where a kind can do so.
#include <cmath>
#include <cstdio>
#include <random>
#include <utility>
#include <variant>
#include <vector>

#include <lightcuts/lightcuts.hpp>

using Matte = lightcuts::Lambert<>;
using Plastic = lightcuts::Sum<lightcuts::Lambert<>, lightcuts::Ggx<>>;
using Brushed = lightcuts::Ward<>;

class AnySurface {
public:
    template <class M>
    explicit AnySurface(const M& material) : any_(material) {}

    glm::vec3 evaluate(const glm::vec3& to_light) const {
        return std::visit([&](const auto& m) { return m.evaluate(to_light); }, any_);
    }
    // May be left out: then `evaluate` is called for one light after the other.
    void evaluate_many(const lightcuts::LaneVectors& to_lights, int count,
                       lightcuts::LaneSpectra<glm::vec3>& values) const {
        std::visit([&](const auto& m) { lightcuts::evaluate_lanes(m, to_lights, count, values); }, any_);
    }
    // Instead of `upper_bound`: what to bound, and the library chooses how.
    template <class F>
    void for_each_component(F&& f) const {
        std::visit(
            [&]<class M>(const M& m) {
                if constexpr (lightcuts::CompositeMaterial<M>) {
                    m.for_each_component(std::forward<F>(f));
                } else {
                    f(m);
                }
            },
            any_);
    }

private:
    std::variant<Matte, Plastic, Brushed> any_;
};
static_assert(lightcuts::CompositeMaterial<AnySurface> && lightcuts::LaneMaterial<AnySurface>);

int main() {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> across(-10.0f, 10.0f), height(2.0f, 6.0f);
    std::vector<lightcuts::OmniLight<>> lights(20'000);
    for (auto& light : lights) {
        light.position = {across(random), across(random), height(random)};
        light.intensity = glm::vec3(1.0f);
    }
    const lightcuts::LightTree tree(lights);

    const glm::vec3 up(0.0f, 0.0f, 1.0f), to_viewer(0.6f, 0.0f, 0.8f), cream(0.8f, 0.7f, 0.5f);
    const Matte matte{up, cream};
    const Plastic plastic{matte, lightcuts::Ggx{up, to_viewer, glm::vec3(0.04f), 0.2f}};
    const Brushed brushed{up, to_viewer, glm::vec3(0.5f), 0.3f};
    const AnySurface surfaces[] = {AnySurface{matte}, AnySurface{plastic}, AnySurface{brushed}};

    // As cheap as if each kind were shaded by itself: the same cut, the same radiance.
    const auto alone = [&](const auto& material) {
        return lightcuts::shade(tree, lightcuts::Receiver(glm::vec3(0.0f), material));
    };
    const lightcuts::CutResult<glm::vec3> expected[] = {alone(matte), alone(plastic), alone(brushed)};
    bool good = true;
    for (int i = 0; i < 3; ++i) {
        const auto shaded = lightcuts::shade(tree, lightcuts::Receiver(glm::vec3(0.0f), surfaces[i]));
        std::printf("%.3f W/(m^2 sr), cut of %u; by itself %.3f, cut of %u\n", shaded.radiance.r, shaded.cut_size,
                    expected[i].radiance.r, expected[i].cut_size);
        good = good && shaded.cut_size == expected[i].cut_size &&
               std::fabs(shaded.radiance.r - expected[i].radiance.r) <= 1e-5f * expected[i].radiance.r;
    }
    return good ? 0 : 1;
}
