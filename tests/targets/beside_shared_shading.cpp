// Succeeds if the loader starts it, and both sides agree.
#include "shading.hpp"
#include "shared_shading.hpp"

int main() {
    const float here = shading();
    return here > 0.0f && here == shared_shading() ? 0 : 1;
}
