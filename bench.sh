#!/usr/bin/env bash
# bench.sh [arguments of `volumark run`]: installs what is missing, builds Release, runs the experiments quick and effects
# and the hard cases on gl, vulkan and cpu, prints their tables, and writes out/bench/{results.json,report.html} and images.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
scripts/setup.sh
cmake --preset release -DVM_TESTS=OFF >/dev/null
cmake --build --preset release -j "$(nproc)"
out=out/bench
args=("$@")
build/release/bin/volumark run quick effects --verify --out "$out" --overwrite "${args[@]+"${args[@]}"}"
build/release/bin/volumark validate "$out/results.json"
build/release/bin/volumark report "$out" | tail -n 1
