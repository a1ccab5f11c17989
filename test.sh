#!/usr/bin/env bash
# test.sh [arguments of ctest]: installs what is missing, builds Release with warnings as errors, fuzzes the parsers for a
# moment, and runs every test on gl, vulkan and cpu. ctest's summary line comes last.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
scripts/setup.sh scripts/packages-test.txt
export VOLUMARK_REQUIRE_DATA=1 # the real volumes have just been fetched: without them their tests fail

cmake --preset fuzz >/dev/null
cmake --build --preset fuzz -j "$(nproc)" --target fuzz
ctest --test-dir build/fuzz -L fuzz -j "$(nproc)" --output-on-failure --no-tests=error

cmake --preset ci >/dev/null
cmake --build --preset ci -j "$(nproc)"
ctest --test-dir build/ci -j "$(nproc)" --output-on-failure --no-tests=error "$@"
