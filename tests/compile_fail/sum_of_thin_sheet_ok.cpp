#include <lightcuts/lightcuts.hpp>

int main() {
    const glm::vec3 up(0.0f, 0.0f, 1.0f);
    const lightcuts::Lambert<float> gloss{up, 0.1f}, front{up, 0.3f}, back{-up, 0.5f};
    const lightcuts::ThinSheet sum{lightcuts::Sum{gloss, front}, back, up};
    return sum.evaluate(up) > 0.0f;
}
