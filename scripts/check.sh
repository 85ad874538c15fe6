#!/bin/bash
# The inner loop: style rules, clang-tidy on what changed, and the quick tests, on a build that is warm.
# usage: scripts/check.sh [BASE]    what changed since the commit BASE (default: HEAD, what is not committed)
# Builds the release preset. Leaves out the tests that render for long and those that run the whole program.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
base=${1:-HEAD}
git rev-parse --verify --quiet "$base^{commit}" >/dev/null || { echo "check.sh: no such commit: $base" >&2; exit 2; }

for rule in format layers arithmetic sizes products documents; do bash tests/style/check.sh "$rule"; done

[ -d build/release ] || cmake --preset release -Wno-dev >/dev/null
cmake --build --preset release

mapfile -t changed < <(git diff --name-only --diff-filter=d "$base" -- '*.cpp')
if [ ${#changed[@]} -gt 0 ] && ! command -v clang-tidy-14 >/dev/null; then
  echo "clang-tidy-14 is missing and left out: apt-get install clang-tidy-14" >&2
elif [ ${#changed[@]} -gt 0 ]; then
  # Clang cannot read GCC's precompiled headers: the preset `tidy` lists the commands without them.
  cmake --preset tidy -Wno-dev >/dev/null
  printf '%s\n' "${changed[@]}" | xargs -P "$(nproc)" -n 1 clang-tidy-14 -p build/tidy --quiet --warnings-as-errors='*'
fi

ctest --preset release -L unit
