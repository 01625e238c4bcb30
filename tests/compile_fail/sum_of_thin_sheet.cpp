// expect: what is lit from both sides is no part of a Sum: make each side of a ThinSheet a sum
#include <lightcuts/lightcuts.hpp>

int main() {
    const glm::vec3 up(0.0f, 0.0f, 1.0f);
    const lightcuts::Lambert<float> gloss{up, 0.1f}, front{up, 0.3f}, back{-up, 0.5f};
    const lightcuts::Sum sum{gloss, lightcuts::ThinSheet{front, back, up}};
    return sum.evaluate(up) > 0.0f;
}
