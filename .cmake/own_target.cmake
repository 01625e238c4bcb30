# How this project compiles what it builds itself; a user of the headers gets none of this.

# The warnings that our code is clean under. CMAKE_COMPILE_WARNING_AS_ERROR, on by default at top level, makes them
# errors.
if(MSVC)
  set(lightcuts_warnings /W4)
else()
  set(lightcuts_warnings -Wall -Wextra -Wpedantic -Wshadow -Wconversion)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # False alarms on `"text" + std::to_string(n)` (GCC bug 105651) and on std::variant (105562).
  list(APPEND lightcuts_warnings -Wno-restrict -Wno-maybe-uninitialized)
endif()

# What compilers may contract into fused multiply-adds; the presets `native` and `native-clang` allow all, to test that
# bounds stay bounds.
set(LIGHTCUTS_FP_CONTRACT off CACHE STRING "-ffp-contract of the project's own programs: off, on or fast")

# C++20 without extensions, under the warnings. Products and sums are rounded one by one, so that results are the same
# bits whatever the compiler and -march; a processor with FMA would save 3 % of a picture's time.
function(lightcuts_own_target target)
  target_compile_features(${target} PRIVATE cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(${target} PRIVATE ${lightcuts_warnings})
  if(NOT MSVC)
    target_compile_options(${target} PRIVATE -ffp-contract=${LIGHTCUTS_FP_CONTRACT})
    # Loops over lanes also for AVX2: see core/vectorized.hpp.
    target_compile_definitions(${target} PRIVATE LIGHTCUTS_SEVERAL_TARGETS)
  endif()
endfunction()

# Finds a package, or says in one line how to get it. Packages' own chatter is not shown: Debian's Imath reports a
# Python library that it does not ship.
macro(lightcuts_need package debian)
  set(lightcuts_log_level "${CMAKE_MESSAGE_LOG_LEVEL}")
  set(CMAKE_MESSAGE_LOG_LEVEL WARNING)
  find_package(${package} QUIET)
  set(CMAKE_MESSAGE_LOG_LEVEL "${lightcuts_log_level}")
  if(NOT ${package}_FOUND)
    message(FATAL_ERROR "lightcuts: ${package} not found; install it (Debian: ${debian}). tests/run.sh installs "
                        "everything; -DLIGHTCUTS_TESTS=OFF, -DLIGHTCUTS_RENDERER=OFF and -DLIGHTCUTS_EXAMPLES=OFF "
                        "ask for less")
  endif()
endmacro()
