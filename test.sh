#!/usr/bin/env bash
# test.sh [arguments of ctest]: installs what is missing, builds Release with warnings as errors, runs every test on gl,
# vulkan and cpu. ctest's summary line comes last.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
scripts/setup.sh scripts/packages-test.txt
cmake --preset ci >/dev/null
cmake --build --preset ci -j "$(nproc)"
ctest --test-dir build/ci -j "$(nproc)" --output-on-failure --no-tests=error "$@"
