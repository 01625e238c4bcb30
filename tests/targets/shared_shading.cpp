#include "shared_shading.hpp"

#include "shading.hpp"

float shared_shading() { return shading(); }
