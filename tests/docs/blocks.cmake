# cmake -D PAGE=name -D ROOT=repository -D COMPILER=g++ -D AWK=awk -D INCLUDE=... -D SCRATCH=folder -P blocks.cmake
cmake_minimum_required(VERSION 3.24)
include(${CMAKE_CURRENT_LIST_DIR}/../consumer/hosts/options.cmake)

set(source ${SCRATCH}/${PAGE}.cpp)
if(PAGE STREQUAL "README")
  set(page ${ROOT}/README.md)
else()
  set(page ${ROOT}/docs/${PAGE}.md)
endif()
execute_process(
  COMMAND ${AWK} "/^```/ { inside = $0 == \"```cpp\"; next } inside" ${page}
  OUTPUT_FILE ${source} RESULT_VARIABLE status
)
file(SIZE ${source} size)
if(NOT status EQUAL 0 OR size LESS 100)
  message(FATAL_ERROR "${page} has no code")
endif()

if(PAGE STREQUAL "README")
  execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${source} ${ROOT}/examples/01_shade_a_point.cpp
                  RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "The code of ${page} is not examples/01_shade_a_point.cpp")
  endif()
  return()
endif()
# Functions of a page are declared by nothing else, and may go unused.
execute_process(
  COMMAND ${COMPILER} -std=c++20 -fsyntax-only -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror
          -Wno-unused-function -Wno-unused-variable ${include_options} ${source}
  RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said
)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${page}\n${said}")
endif()
