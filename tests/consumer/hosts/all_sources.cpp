// All headers that need nothing but GLM.
#include <lightcuts/lightcuts.hpp>
#include <lightcuts/source/area.hpp>
#include <lightcuts/source/environment.hpp>
#include <lightcuts/source/sphere.hpp>
#include <lightcuts/source/sun_sky.hpp>
#include <lightcuts/source/virtual_lights.hpp>

template class lightcuts::LightTree<lightcuts::OmniLight<>>;
template class lightcuts::LightTree<lightcuts::OrientedPointLight<float>>;
template class lightcuts::LightTree<lightcuts::DistantLight<>>;
template class lightcuts::LightForest<lightcuts::OmniLight<>, lightcuts::DistantLight<>>;
template class lightcuts::Ggx<>;
template class lightcuts::Ward<>;
template class lightcuts::ModifiedPhong<>;

int main() {}
