# cmake -D SCRATCH=folder -P broken_rules.cmake
#
# Breaks each rule of floors.cmake in a tree of one header and checks that it is refused with the right words.
cmake_minimum_required(VERSION 3.24)

function(expect_fault header include words)
  file(REMOVE_RECURSE ${SCRATCH})
  file(WRITE ${SCRATCH}/${header} "#pragma once\n${include}\n")
  execute_process(
    COMMAND ${CMAKE_COMMAND} -D HEADERS=${SCRATCH} -P ${CMAKE_CURRENT_LIST_DIR}/floors.cmake
    RESULT_VARIABLE status ERROR_VARIABLE said
  )
  if(words STREQUAL "" AND NOT status EQUAL 0)
    message(SEND_ERROR "${header} with ${include} should be accepted, but:\n${said}")
  elseif(NOT words STREQUAL "" AND (status EQUAL 0 OR NOT said MATCHES "${words}"))
    message(SEND_ERROR "${header} with ${include} should be refused with \"${words}\", but:\n${said}")
  endif()
endfunction()

expect_fault(cut/a.hpp "#include <vector>\n#include <glm/vec3.hpp>\n#include \"../core/b.hpp\"\n#include \"c.hpp\"" "")
expect_fault(lightcuts.hpp "#include \"estimate/b.hpp\"" "")
expect_fault(adapt/a.hpp "#include <embree3/rtcore.h>" "")
expect_fault(tree/a.hpp "#include \"build/b.hpp\"" "")
expect_fault(tree/build/a.hpp "#include \"../b.hpp\"\n#include \"c.hpp\"\n#include \"../../core/d.hpp\"" "")
expect_fault(cut/a.hpp "#include \"../tree/build/b.hpp\"" "")
expect_fault(tree/build/a.hpp "#include \"../../bound/b.hpp\"" "does not come before")
expect_fault(light/a.hpp "#include \"../tree/build/b.hpp\"" "does not come before")
expect_fault(tree/build/a.hpp "#include \"../../lightcuts.hpp\"" "includes the umbrella")
expect_fault(cut/a.hpp "#include \"../tree/parts/b.hpp\"" "there is no folder")
expect_fault(tree/build/deep/a.hpp "" "FOLDER/noun")
expect_fault(core/a.hpp "#include \"../light/b.hpp\"" "does not come before")
expect_fault(bound/a.hpp "  #  include \"../cut/b.hpp\"" "does not come before")
expect_fault(lightcuts.hpp "#include \"source/b.hpp\"" "does not come before")
expect_fault(core/a.hpp "#include \"../kernel/b.hpp\"" "there is no folder")
expect_fault(matrix/a.hpp "#include \"../lightcuts.hpp\"" "includes the umbrella")
expect_fault(cut/a.hpp "#include <lightcuts/core/b.hpp>" "may be included")
expect_fault(cut/a.hpp "#include <embree3/rtcore.h>" "may be included")
expect_fault(cut/a.hpp "#include <boost/heap.hpp>" "may be included")
expect_fault(cut/a.hpp "#include <immintrin.h>" "may be included")
expect_fault(kernel/a.hpp "" "none of the folders")
expect_fault(core/detail/a.hpp "" "FOLDER/noun")
expect_fault(core/a.h "" "FOLDER/noun")
