// Prints a hash of the bits of what many cuts and their bounds come to.
#include <bit>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <lightcuts/lightcuts.hpp>
#include "support/random.hpp"

namespace {

using V = glm::vec3;

std::uint64_t hash = 14695981039346656037u;
void add(const V& v) {
    for (int k = 0; k < 3; ++k) hash = (hash ^ std::bit_cast<std::uint32_t>(v[k])) * 1099511628211u;
}

}  // namespace

int main() {
    using namespace lightcuts;
    test::Random random(1);
    const auto color = [&] { return V(random.unit(), random.unit(), random.unit()); };
    std::vector<OrientedPointLight<>> lamps;
    std::vector<OmniLight<>> omnis;
    std::vector<DistantLight<>> suns;
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec3 at(random.between(-3.0, 3.0), random.between(-3.0, 3.0), random.between(1.0, 4.0));
        lamps.push_back({V(at), V(random.on_sphere()), color()});
        omnis.push_back({V(at.y, at.z, at.x), color()});
        suns.push_back({V(random.on_sphere()), color()});
    }
    const LightTree lamp_tree(lamps);
    const LightTree omni_tree(omnis);
    const LightTree sun_tree(suns);
    const LightForest forest(lamp_tree, omni_tree, sun_tree);
    for (int i = 0; i < 300; ++i) {
        const V at(random.between(-3.0, 3.0), random.between(-3.0, 3.0), random.between(-1.0, 2.0));
        const V normal(random.on_sphere()), view(random.near(glm::dvec3(normal), 1.2));
        const Sum glossy{Lambert<V>{normal, color()}, Ggx<V>{normal, view, color(), 0.2f},
                         ModifiedPhong<V>{normal, view, color(), 40.0f}};
        const auto result = shade(forest, Receiver(at, glossy), AlwaysVisible{});
        add(result.radiance);
        add(result.error_bound);
    }
    std::printf("%016llx\n", static_cast<unsigned long long>(hash));
}
