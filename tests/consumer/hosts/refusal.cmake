# cmake -D CASE=name -D COMPILER=g++ -D INCLUDE=folder;folder -D SCRATCH=folder -P refusal.cmake
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/options.cmake)
file(MAKE_DIRECTORY ${SCRATCH})

if(CASE STREQUAL "cxx17")
  # One line, before any header of the library can fail in its own way.
  file(WRITE ${SCRATCH}/cxx17.cpp "#include <lightcuts/lightcuts.hpp>\n")
  execute_process(
    COMMAND ${COMPILER} -std=c++17 -fsyntax-only ${include_options} ${SCRATCH}/cxx17.cpp
    RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said
  )
  string(REGEX MATCHALL " error: " errors "${said}")
  list(LENGTH errors count)
  if(status EQUAL 0 OR NOT count EQUAL 1 OR NOT said MATCHES "lightcuts needs C\\+\\+20")
    message(FATAL_ERROR "${count} errors with C++17:\n${said}")
  endif()
  return()
endif()

execute_process(
  COMMAND ${COMPILER} -std=c++20 -fno-exceptions ${include_options} ${CMAKE_CURRENT_LIST_DIR}/${CASE}.cpp -o
          ${SCRATCH}/program
  RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said
)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${said}")
endif()
execute_process(COMMAND ${SCRATCH}/program RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(CASE STREQUAL "throw_replaced" AND NOT status EQUAL 0)
  message(FATAL_ERROR "${status}: ${said}")
elseif(CASE STREQUAL "no_exceptions_end"
       AND (status EQUAL 0 OR NOT said MATCHES "lightcuts: light 1: intensity is negative or not a number"))
  message(FATAL_ERROR "${status}: ${said}")
endif()
