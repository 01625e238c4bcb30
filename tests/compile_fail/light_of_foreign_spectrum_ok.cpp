#include <vector>

#include <lightcuts/lightcuts.hpp>

/// Four bands that the library cannot read: no channels, no operator[].
struct Bands {
    float at[4] = {};
    friend Bands operator+(const Bands& a, const Bands&) { return a; }
    friend Bands operator*(const Bands& a, const Bands&) { return a; }
    friend Bands operator*(const Bands& a, float) { return a; }
    static constexpr int channels = 4;
    float operator[](int i) const { return at[i]; }
    float& operator[](int i) { return at[i]; }
};

struct Bulb {
    glm::vec3 position{0.0f};
    Bands intensity;
};

int main() {
    const std::vector<Bulb> bulbs(3);
    const lightcuts::LightTree tree(bulbs);
}
