# Installs into an empty place, builds deploy/example against that and nothing else, and runs it and the programs.
# cmake -D BUILD=… -D SOURCE=… -D PLACE=… -D CONFIG=… -P install_test.cmake
file(REMOVE_RECURSE ${PLACE})
function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${PLACE}/installed)
run(${CMAKE_COMMAND} -G Ninja -S ${SOURCE}/deploy/example -B ${PLACE}/example
  -D CMAKE_BUILD_TYPE=${CONFIG} -D CMAKE_PREFIX_PATH=${PLACE}/installed -D CMAKE_CXX_FLAGS=${FLAGS})
run(${CMAKE_COMMAND} --build ${PLACE}/example)
run(${PLACE}/example/example ${PLACE}/sphere.png)
file(SIZE ${PLACE}/sphere.png bytes)
if(bytes LESS 1000)
  message(FATAL_ERROR "The example's picture has ${bytes} bytes.")
endif()
run(${PLACE}/installed/bin/antipode --version)
run(${PLACE}/installed/bin/antipode-server --version)

# Nothing that is installed may lead back to where it was built.
file(GLOB_RECURSE texts ${PLACE}/installed/*.h ${PLACE}/installed/*.cmake)
foreach(text IN LISTS texts)
  file(READ ${text} content)
  string(FIND "${content}" "${SOURCE}" found)
  if(NOT found EQUAL -1)
    message(FATAL_ERROR "${text} names the folder that it was built in.")
  endif()
endforeach()
