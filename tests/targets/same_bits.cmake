# cmake -D ONE=program -D SEVERAL=program -P same_bits.cmake
foreach(program ONE SEVERAL)
  execute_process(COMMAND ${${program}} OUTPUT_VARIABLE ${program}_said COMMAND_ERROR_IS_FATAL ANY)
endforeach()
if(NOT ONE_said STREQUAL SEVERAL_said OR ONE_said STREQUAL "")
  message(FATAL_ERROR "one target: ${ONE_said}several targets: ${SEVERAL_said}")
endif()
