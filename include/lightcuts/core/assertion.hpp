#pragma once

/// Checks a documented precondition on a hot path. Define it before including the library to replace it; by default
/// it is `assert`.
#ifndef LIGHTCUTS_ASSERT
#include <cassert>
#define LIGHTCUTS_ASSERT(condition) assert(condition)
#endif
