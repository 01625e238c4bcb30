# Builds and runs the project in this folder as a user would: from an installation in an empty folder
# (LIGHTCUTS_BUILD), or with the sources inside the user's project (LIGHTCUTS_SOURCE).
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
  set(where -D CMAKE_PREFIX_PATH=${SCRATCH}/prefix -D LIGHTCUTS_COMPONENTS=${LIGHTCUTS_COMPONENTS})
else()
  set(where -D LIGHTCUTS_SOURCE=${LIGHTCUTS_SOURCE})
endif()
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${SCRATCH}/build -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${COMPILER} ${where})
run(${CMAKE_COMMAND} --build ${SCRATCH}/build)
run(${SCRATCH}/build/consumer)
