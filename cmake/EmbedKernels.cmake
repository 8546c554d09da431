# tessera_embed_kernels(TARGET FILE...): compiles kernel sources into TARGET.
# The sources are found at run time by their path below src/, through kernelSource() in src/device/kernel_sources.h.
function(tessera_embed_kernels target)
    set(output ${CMAKE_CURRENT_BINARY_DIR}/kernel_sources.cpp)
    set(paths)
    foreach(file IN LISTS ARGN)
        list(APPEND paths ${CMAKE_CURRENT_SOURCE_DIR}/${file})
    endforeach()
    add_custom_command(
        OUTPUT ${output}
        COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DROOT=${CMAKE_CURRENT_SOURCE_DIR} "-DFILES=${ARGN}"
                -P ${PROJECT_SOURCE_DIR}/cmake/WriteKernelSources.cmake
        DEPENDS ${paths} ${PROJECT_SOURCE_DIR}/cmake/WriteKernelSources.cmake
        COMMENT "Embedding kernels"
        VERBATIM)
    target_sources(${target} PRIVATE ${output})
endfunction()
