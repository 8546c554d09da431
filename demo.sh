#!/usr/bin/env bash
# Sets up, builds, and renders the built-in teapot to teapot.png in the current folder.
set -euo pipefail
root=$(cd "$(dirname "$0")" && pwd)

"$root/tools/setup.sh"
echo "Building Tessera (some minutes the first time)"
(
    cd "$root"
    options=()
    # The libraries that the tests need are not there yet; where test.sh has been before, its build is taken.
    [[ -f build/release/CMakeCache.txt ]] || options=(-DTESSERA_BUILD_TESTS=OFF -DTESSERA_BUILD_BENCH=OFF)
    tools/quietly.sh cmake --preset release "${options[@]}"
    tools/quietly.sh cmake --build --preset release --target tessera_program
)
"$root/build/release/apps/tessera/tessera" render teapot -o teapot.png
echo "The picture is $PWD/teapot.png"
