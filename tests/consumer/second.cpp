#include <lightcuts/lightcuts.hpp>

float intensity_seen_from_second() {
    lightcuts::OmniLight<> light;
    light.intensity = glm::vec3(3.0f);
    return light.intensity.y;
}
