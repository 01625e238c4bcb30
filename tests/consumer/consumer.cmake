# Builds and runs the project in this folder as a user would: from an installation in an empty folder
# (LIGHTCUTS_BUILD), by CMake or by the compiler and pkg-config (PKG_CONFIG), or with the sources inside the user's
# project (LIGHTCUTS_SOURCE).
cmake_minimum_required(VERSION 3.24)

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\n${said}")
  endif()
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
file(MAKE_DIRECTORY ${SCRATCH})
if(LIGHTCUTS_BUILD)
  run(${CMAKE_COMMAND} --install ${LIGHTCUTS_BUILD} --prefix ${SCRATCH}/prefix)
  if(NOT EXISTS ${SCRATCH}/prefix/share/doc/lightcuts/LICENSE)
    message(FATAL_ERROR "the licence is not installed")
  endif()
  set(where -D CMAKE_PREFIX_PATH=${SCRATCH}/prefix -D LIGHTCUTS_COMPONENTS=${LIGHTCUTS_COMPONENTS})
else()
  set(where -D LIGHTCUTS_SOURCE=${LIGHTCUTS_SOURCE})
endif()

if(PKG_CONFIG)
  # Nothing may point to where it was installed first.
  file(RENAME ${SCRATCH}/prefix ${SCRATCH}/moved)
  set(ENV{PKG_CONFIG_PATH} ${SCRATCH}/moved/share/pkgconfig)
  execute_process(
    COMMAND ${PKG_CONFIG} --cflags --libs lightcuts
    RESULT_VARIABLE status OUTPUT_VARIABLE flags ERROR_VARIABLE said OUTPUT_STRIP_TRAILING_WHITESPACE
  )
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${PKG_CONFIG}: ${said}")
  endif()
  separate_arguments(flags UNIX_COMMAND "${flags}")
  file(GLOB sources ${SOURCE}/*.cpp)
  run(${COMPILER} -std=c++20 ${sources} ${flags} -o ${SCRATCH}/consumer)
  run(${SCRATCH}/consumer)
  return()
endif()

run(${CMAKE_COMMAND} -S ${SOURCE} -B ${SCRATCH}/build -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${COMPILER} ${where})
run(${CMAKE_COMMAND} --build ${SCRATCH}/build)
run(${SCRATCH}/build/consumer)
