#!/usr/bin/env bash
# lint.sh [format|includes|tidy]: clang-format over every source file, includes that run downwards only, clang-tidy over
# everything that build/ci compiles. Without an argument all of them. Exits 1 where something is to be changed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
what=${1:-all}

sources() { git ls-files '*.h' '*.cpp'; }

# check_includes FOLDER ALLOWED...: what FOLDER includes of the house must lie in itself or in ALLOWED.
check_includes() {
  local folder=$1 allowed
  allowed=$(printf '%s|' "$@")
  if sources | grep "^$folder/" | xargs grep -nE '^#include "(backends|scenes|methods|harness|reports|tests)/' |
    grep -vE "#include \"(${allowed%|})/"; then
    echo "$folder/ may include: $*" >&2
    return 1
  fi
}

if [ "$what" = format ] || [ "$what" = all ]; then
  sources | xargs clang-format --dry-run -Werror
fi
if [ "$what" = includes ] || [ "$what" = all ]; then
  check_includes backends
  check_includes scenes
  check_includes reports
  check_includes methods scenes backends
  check_includes harness methods reports scenes backends
fi
if [ "$what" = tidy ] || [ "$what" = all ]; then
  sources | grep '\.cpp$' | xargs -P "$(nproc)" -n 4 clang-tidy -p build/ci --quiet --extra-arg=-Wno-unknown-warning-option
fi
