#include <lightcuts/lightcuts.hpp>

float intensity_seen_from_second();

static_assert(lightcuts::PointLight<lightcuts::OmniLight<>>);

int main() {
    lightcuts::OmniLight<> light;
    light.intensity = glm::vec3(3.0f);
    return light.intensity.x == intensity_seen_from_second() ? 0 : 1;
}
