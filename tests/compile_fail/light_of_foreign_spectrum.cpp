// expect: a light needs intensity(): a float, a glm::vec3 or another Spectrum; a member, or a function of
#include <vector>

#include <lightcuts/lightcuts.hpp>

/// Four bands that the library cannot read: no channels, no operator[].
struct Bands {
    float at[4] = {};
    friend Bands operator+(const Bands& a, const Bands&) { return a; }
    friend Bands operator*(const Bands& a, const Bands&) { return a; }
    friend Bands operator*(const Bands& a, float) { return a; }
};

struct Bulb {
    glm::vec3 position{0.0f};
    Bands intensity;
};

int main() {
    const std::vector<Bulb> bulbs(3);
    const lightcuts::LightTree tree(bulbs);
}
