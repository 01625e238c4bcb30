# cmake -D COMPILER=g++ -D SOURCE=NAME.cpp -D INCLUDE=folder;folder -P compile_fail.cmake
cmake_minimum_required(VERSION 3.24)

set(include_options "")
foreach(folder IN LISTS INCLUDE)
  # Naming a compiler's own folder again would change the order of its search.
  if(folder AND NOT folder STREQUAL "/usr/include")
    list(APPEND include_options "-I${folder}")
  endif()
endforeach()

macro(compile source)
  execute_process(
    COMMAND ${COMPILER} -std=c++20 -fsyntax-only ${include_options} ${source}
    RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said
  )
endmacro()

file(STRINGS ${SOURCE} sentences REGEX "^ *// expect: ")
if(NOT sentences)
  message(FATAL_ERROR "${SOURCE} has no line `// expect: sentence`")
endif()
compile(${SOURCE})
if(status EQUAL 0)
  message(FATAL_ERROR "${SOURCE} compiles, and should not")
endif()
foreach(sentence IN LISTS sentences)
  string(REGEX REPLACE "^ *// expect: " "" sentence "${sentence}")
  string(STRIP "${sentence}" sentence)
  string(FIND "${said}" "${sentence}" found)
  if(found EQUAL -1)
    message("${said}")
    message(FATAL_ERROR "The compiler does not say \"${sentence}\"")
  endif()
endforeach()

string(REGEX REPLACE "\\.cpp$" "_ok.cpp" twin ${SOURCE})
compile(${twin})
if(NOT status EQUAL 0)
  message("${said}")
  message(FATAL_ERROR "${twin} should compile")
endif()
