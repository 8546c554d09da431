#!/usr/bin/env bash
# Installs what Tessera needs from the packages of Debian 12, Ubuntu 24.04 or later.
# tools/setup.sh: to build and to render. tools/setup.sh --with-tests: to run the tests and the checks of the sources as well.
# tools/setup.sh --with-bench: to run the benchmarks and the evaluation with its plots (bench/evaluate.py).
# Says nothing and changes nothing where all of it is there.
set -euo pipefail

wanted=(
    cmake ninja-build g++ pkgconf
    ocl-icd-opencl-dev opencl-clhpp-headers pocl-opencl-icd libglm-dev
    capnproto libcapnp-dev libopenimageio-dev libassimp-dev libdraco-dev libosd-dev zlib1g-dev libcli11-dev nlohmann-json3-dev
)
case "${1-}" in
    "") ;;
    --with-bench) wanted+=(libbenchmark-dev python3-matplotlib
        # A header that the modeling packages include is in the visualization one.
        libocct-foundation-dev libocct-modeling-data-dev libocct-modeling-algorithms-dev libocct-visualization-dev) ;;
    --with-tests) wanted+=(libgtest-dev libbenchmark-dev libembree-dev clang libclang-rt-dev llvm clang-format clang-tidy) ;;
    *) echo "usage: tools/setup.sh [--with-tests | --with-bench]" >&2; exit 2 ;;
esac

fail() {
    echo "setup: $1" >&2
    exit 1
}

if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    fail "this is no Debian or Ubuntu; install what these packages hold, then build with 'cmake --preset release': ${wanted[*]}"
fi

installed=$(dpkg-query -W -f='${Package} ${db:Status-Status}\n' "${wanted[@]}" 2>/dev/null || true)
missing=()
for package in "${wanted[@]}"; do
    grep -qx "$package installed" <<<"$installed" || missing+=("$package")
done

if ((${#missing[@]} > 0)); then
    as_root=()
    if [[ $(id -u) -ne 0 ]]; then
        command -v sudo >/dev/null || fail "packages are missing; as root run: apt-get install --no-install-recommends ${missing[*]}"
        as_root=(sudo)
    fi
    echo "Installing packages: ${missing[*]}"
    log=$(mktemp)
    trap 'rm -f "$log"' EXIT
    options=(-qq -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3)
    # A foreign source that does not answer fails the update, and yet what is wanted here may install.
    "${as_root[@]}" apt-get "${options[@]}" update >"$log" 2>&1 || true
    if ! "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get "${options[@]}" install -y --no-install-recommends "${missing[@]}" >>"$log" 2>&1; then
        tail -n 20 "$log" >&2
        fail "the packages above could not be installed"
    fi
fi

version=$(cmake --version | awk 'NR == 1 {print $3}')
if [[ $(printf '%s\n' 3.25 "$version" | sort -V | head -n 1) != 3.25 ]]; then
    fail "cmake $version is too old; install 3.25 or later (Debian 12 and Ubuntu 24.04 have it)"
fi
