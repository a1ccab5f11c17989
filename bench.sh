#!/usr/bin/env bash
# bench.sh [arguments of `volumark run quick`]: installs what is missing, builds Release, runs the quick experiment on gl,
# vulkan and cpu, prints its tables, and writes out/quick/{results.json,report.html} and the images.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
scripts/setup.sh
cmake --preset release -DVM_TESTS=OFF >/dev/null
cmake --build --preset release -j "$(nproc)"
out=out/quick
args=("$@")
build/release/bin/volumark run quick --out "$out" --overwrite "${args[@]+"${args[@]}"}"
build/release/bin/volumark validate "$out/results.json"
build/release/bin/volumark report "$out" | tail -n 1
