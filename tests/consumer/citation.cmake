# cmake -D CITATION=CITATION.cff -D VERSION=0.1.0 -P citation.cmake: does it state this version and its format?
cmake_minimum_required(VERSION 3.24)
foreach(line "cff-version: 1.2.0" "version: ${VERSION}" "license: Apache-2.0")
  string(REPLACE "." "\\." pattern "^${line}$")
  file(STRINGS ${CITATION} found REGEX "${pattern}")
  if(NOT found)
    message(FATAL_ERROR "${CITATION}: there is no line `${line}`")
  endif()
endforeach()
