# What `cmake --install` puts where: the core library and subdivision surfaces, with their headers and a package for find_package(tessera).
# The program has its own rule, in its folder. File formats, tests and benchmarks stay in the build folder.
include(CMakePackageConfigHelpers)

set(TESSERA_CMAKE_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/tessera)
set(TESSERA_PACKAGE_FOLDER ${PROJECT_BINARY_DIR}/package)

install(TARGETS tessera EXPORT tesseraTargets)
if(TARGET tessera_subdivision)
    set_target_properties(tessera_subdivision PROPERTIES EXPORT_NAME subdivision)
    set_target_properties(tessera_opensubdiv PROPERTIES EXPORT_NAME opensubdiv)
    install(TARGETS tessera_subdivision tessera_opensubdiv EXPORT tesseraTargets)
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/tessera TYPE INCLUDE)
install(EXPORT tesseraTargets NAMESPACE tessera:: DESTINATION ${TESSERA_CMAKE_FOLDER})

configure_package_config_file(
    ${CMAKE_CURRENT_LIST_DIR}/tesseraConfig.cmake.in ${TESSERA_PACKAGE_FOLDER}/tesseraConfig.cmake
    INSTALL_DESTINATION ${TESSERA_CMAKE_FOLDER}
    NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${TESSERA_PACKAGE_FOLDER}/tesseraConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${TESSERA_PACKAGE_FOLDER}/tesseraConfig.cmake ${TESSERA_PACKAGE_FOLDER}/tesseraConfigVersion.cmake
        DESTINATION ${TESSERA_CMAKE_FOLDER})
