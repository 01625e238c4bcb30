#pragma once

/// Everything that shading by lightcuts needs. Library headers never include this file.

#if !(__cplusplus >= 202002L) && !(defined(_MSVC_LANG) && _MSVC_LANG >= 202002L)
#error "lightcuts needs C++20: compile with -std=c++20 or later (MSVC: /std:c++20)"
#else

#include "cut/learned_visibility.hpp"
#include "cut/lightcut.hpp"
#include "estimate/adaptive_splitting.hpp"
#include "estimate/exhaustive.hpp"
#include "estimate/power.hpp"
#include "estimate/resampled.hpp"
#include "estimate/stochastic_lightcuts.hpp"
#include "estimate/tree_sampling.hpp"
#include "estimate/ward.hpp"
#include "light/clampable.hpp"
#include "light/directional.hpp"
#include "light/omni.hpp"
#include "light/oriented.hpp"
#include "light/scattering.hpp"
#include "light/spot.hpp"
#include "material/above_horizon.hpp"
#include "material/bounded_by.hpp"
#include "material/capped.hpp"
#include "material/ggx.hpp"
#include "material/lambert.hpp"
#include "material/phong.hpp"
#include "material/sum.hpp"
#include "material/thin_sheet.hpp"
#include "material/ward.hpp"
#include "tree/build/agglomerate.hpp"
#include "tree/build/divide.hpp"
#include "tree/light_tree.hpp"
#include "tree/summary.hpp"
#include "tree/validate.hpp"

#endif
