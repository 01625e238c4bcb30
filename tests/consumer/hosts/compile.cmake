# cmake -D COMPILER=g++ -D FLAGS=flag;flag -D SOURCES=file;file -D INCLUDE=folder;folder -P compile.cmake
cmake_minimum_required(VERSION 3.22)
include(${CMAKE_CURRENT_LIST_DIR}/options.cmake)
foreach(source IN LISTS SOURCES)
  execute_process(
    COMMAND ${COMPILER} -std=c++20 -fsyntax-only -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Werror ${FLAGS}
            ${include_options} ${source}
    RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said
  )
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${COMPILER} ${FLAGS} ${source}\n${said}")
  endif()
endforeach()
