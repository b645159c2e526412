# cmake -DBUILD=… -DSOURCE=… -DWORK=… -DMODEL=… -P run.cmake: installs, builds the consumer against it, and runs it.
function(must)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGV}\n${text}")
  endif()
  message(STATUS "${text}")
endfunction()

file(REMOVE_RECURSE "${WORK}")
must("${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${WORK}/prefix")
must("${CMAKE_COMMAND}" -G Ninja -S "${SOURCE}" -B "${WORK}/build" "-DCMAKE_PREFIX_PATH=${WORK}/prefix"
     -DCMAKE_BUILD_TYPE=Release)
must("${CMAKE_COMMAND}" --build "${WORK}/build")
must("${WORK}/build/fall" "${MODEL}" "${WORK}/fall.glb")
if(NOT EXISTS "${WORK}/fall.glb")
  message(FATAL_ERROR "the consumer wrote no clip")
endif()
must("${WORK}/prefix/bin/lutka" --version)
