# Registers the test that installs Tessera and builds a program against it. Label "once": the same whatever runs the kernels.
add_test(NAME InstalledPackageBuildsAProgramThatRenders
         COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} -DSOURCE=${CMAKE_CURRENT_LIST_DIR}
                 -DFOLDER=${PROJECT_BINARY_DIR}/install_consumer -DCOMPILER=${CMAKE_CXX_COMPILER} -DGENERATOR=${CMAKE_GENERATOR}
                 -P ${CMAKE_CURRENT_LIST_DIR}/run.cmake)
set_tests_properties(InstalledPackageBuildsAProgramThatRenders PROPERTIES TIMEOUT 600 LABELS once)
