#!/usr/bin/env bash
# lint.sh [format|tidy]: clang-format over every source file of the tree, clang-tidy over everything that build/ci compiles.
# Without an argument both. Exits 1 where something is to be changed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
what=${1:-all}

sources() { git ls-files '*.h' '*.cpp' '*.h.in' | grep -v '\.in$'; }

if [ "$what" = format ] || [ "$what" = all ]; then
  sources | xargs clang-format --dry-run -Werror
fi
if [ "$what" = tidy ] || [ "$what" = all ]; then
  # One translation unit a file: the same file compiled for several instruction sets is looked at once.
  sources | grep '\.cpp$' | xargs -P "$(nproc)" -n 4 clang-tidy -p build/ci --quiet
fi
