# cmake -DBUILD=... -DSOURCE=... -DFOLDER=... -DCOMPILER=... -DGENERATOR=... -P run.cmake
# Installs the build in BUILD into FOLDER, then builds the project in SOURCE against what was installed, and runs it.
file(REMOVE_RECURSE ${FOLDER})

function(run)
    execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/prefix)
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE} -B ${FOLDER}/build -DCMAKE_PREFIX_PATH=${FOLDER}/prefix
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${FOLDER}/build)
run(${FOLDER}/build/install_consumer)
run(${FOLDER}/prefix/bin/tessera devices)

# Public headers, the core and subdivision surfaces: nothing of file formats or tests, and no header from the inside.
file(GLOB_RECURSE headers RELATIVE ${FOLDER}/prefix ${FOLDER}/prefix/*.h ${FOLDER}/prefix/*.clh)
list(FILTER headers EXCLUDE REGEX "^include/tessera/[a-z_]+\\.h$")
file(GLOB libraries RELATIVE ${FOLDER}/prefix ${FOLDER}/prefix/lib/*.* ${FOLDER}/prefix/lib/*/*.a)
list(FILTER libraries EXCLUDE REGEX "libtessera(_subdivision)?\\.(a|so)")
if(headers OR libraries)
    message(FATAL_ERROR "installed, and should not be: ${headers} ${libraries}")
endif()
