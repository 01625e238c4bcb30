// A host that compiles without exceptions and leaves by a way of its own.
#include <cstdlib>
#include <cstring>

[[noreturn]] inline void refuse(const char* what) { std::exit(std::strstr(what, "light 1") != nullptr ? 0 : 2); }
#define LIGHTCUTS_THROW(error) ::refuse((error).what())

#include <lightcuts/lightcuts.hpp>

int main() {
    std::vector<lightcuts::OmniLight<>> lights(2);
    lights[1].intensity = glm::vec3(-1.0f);
    const lightcuts::LightTree tree(lights);
    return 1;
}
