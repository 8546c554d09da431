#!/usr/bin/env bash
# Sets up, builds and tests: the optimised build under both of PoCL's work-group methods, then a build of clang++ with the
# address and undefined-behaviour sanitizers. Ends with ctest's closing lines.
set -euo pipefail
cd "$(dirname "$0")"

tools/setup.sh --with-tests
tools/check_format.sh

tests_log=$(mktemp)
trap 'rm -f "$tests_log"' EXIT

# run_tests FOLDER METHOD [CTEST OPTION...]: the tests of a build under one of PoCL's work-group methods. Each has its own
# caches, for a compiled kernel does not say how it was made.
run_tests() {
    local folder=$1 method=$2
    shift 2
    local caches=$PWD/$folder/caches/$method
    mkdir -p "$caches/pocl" "$caches/tessera"
    if ! POCL_WORK_GROUP_METHOD=$method POCL_CACHE_DIR=$caches/pocl TESSERA_CACHE=$caches/tessera \
        ctest --test-dir "$folder" --no-tests=error --output-on-failure --no-label-summary -j "$(nproc)" "$@" </dev/null >"$tests_log" 2>&1; then
        grep -vE ' Passed |^ +Start +[0-9]+: ' "$tests_log" || true
        exit 1
    fi
    grep -A 2 'tests passed' "$tests_log"
}

echo "Building with $(c++ --version | head -n 1)"
tools/quietly.sh cmake --preset release -DTESSERA_BUILD_TESTS=ON -DTESSERA_BUILD_BENCH=ON
tools/quietly.sh cmake --build --preset release
echo "Testing, work-group method loopvec"
run_tests build/release loopvec
echo "Testing, work-group method loops"
run_tests build/release loops -LE once

echo "Building with $(clang++ --version | head -n 1) and sanitizers"
# PoCL and the LLVM in it keep memory until the process ends; the tests are listed while building.
export LSAN_OPTIONS="suppressions=$PWD/tests/lsan.supp:print_suppressions=0"
export UBSAN_OPTIONS=print_stacktrace=1
# Less optimised and with no more than lines to report, which halves the time to build.
tools/quietly.sh cmake --preset asan -B build/asan-clang -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
    -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -gline-tables-only"
tools/quietly.sh cmake --build build/asan-clang
echo "Testing with sanitizers"
run_tests build/asan-clang loopvec -LE 'once|long'
