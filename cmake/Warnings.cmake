# tessera_options(TARGET): what every target of the house is compiled with. Warnings are errors.
function(tessera_options target)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Werror
        # The host runs kernel headers too: contraction would change their bits.
        -ffp-contract=off)
    # GCC 12 warns of std::string's own operator+ at -O3 (GCC bug 105651).
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
    target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/src)
    if(TESSERA_SANITIZE)
        target_compile_options(${target} PRIVATE -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
        target_link_options(${target} PUBLIC -fsanitize=address,undefined)
    endif()
endfunction()
