#!/usr/bin/env bash
# Runs clang-tidy, as .clang-tidy says, over the sources; needs a configured release build (cmake --preset release, and built once
# for generated headers). tools/tidy.sh [FILE...]: these only.
set -euo pipefail
cd "$(dirname "$0")/.."

database=build/release
[[ -f $database/compile_commands.json ]] || { echo "tidy: $database is not configured; run cmake --preset release first" >&2; exit 1; }
tidy=$(command -v clang-tidy-14 || command -v clang-tidy) || { echo "tidy: clang-tidy is not here; run tools/setup.sh --with-tests" >&2; exit 1; }

if (($# > 0)); then
    sources=("$@")
else
    mapfile -t sources < <(find src apps tests bench examples -name '*.cpp' -not -path 'tests/install_consumer/*' -not -path '*/fuzz/*' | sort)
fi
# gcc's options that clang does not know are no findings.
printf '%s\0' "${sources[@]}" | xargs -0 -n 1 -P "$(nproc)" "$tidy" -p "$database" --quiet --extra-arg=-Wno-unknown-warning-option 2>/dev/null
