#!/bin/bash
# The inner loop: style rules, clang-tidy on the lines that changed, and the quick tests, on a build that is warm.
# usage: scripts/check.sh [BASE]    what changed since the commit BASE (default: HEAD, what is not committed)
# Builds the release preset. Leaves out tests that take more than a second, that render, and that run the whole program.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
base=${1:-HEAD}
git rev-parse --verify --quiet "$base^{commit}" >/dev/null || { echo "check.sh: no such commit: $base" >&2; exit 2; }

printf '%s\n' format layers arithmetic sizes products documents | xargs -P "$(nproc)" -n 1 bash tests/style/check.sh

[ -d build/release ] || cmake --preset release -Wno-dev >/dev/null
cmake --build --preset release

changed=$(git diff -U0 --diff-filter=d "$base" -- '*.cpp'
  git ls-files --others --exclude-standard -- '*.cpp' | xargs -r -n 1 git diff -U0 --no-index /dev/null || true)
if [ -n "$changed" ] && ! command -v clang-tidy-diff-14.py >/dev/null; then
  echo "clang-tidy-14 is missing and left out: apt-get install clang-tidy-14" >&2
elif [ -n "$changed" ]; then
  # Clang cannot read GCC's precompiled headers: the preset `tidy` lists the commands without them.
  cmake --preset tidy -Wno-dev >/dev/null
  found=$(clang-tidy-diff-14.py -p1 -clang-tidy-binary clang-tidy-14 -path build/tidy -quiet -j "$(nproc)" \
    <<< "$changed" 2>&1 | grep -v -E '^[0-9]+ warnings? ')
  if grep -q -E '(warning|error): ' <<< "$found"; then
    printf '%s\n' "$found" >&2
    exit 1
  fi
fi

# One process for each program: starting a process a test takes longer than most tests. CI runs those left out.
long='BallBeforeBall*:*BlockSlams*:CorridorLoop*:EdgeProfile*:HiddenMostly*:*HiddenSlivers*:LampBehind*:LightSourcePool*'
long+=':*MappingFilter*:*NoiseLaw.Errors*:*NotMatt*:NoisyBearings*:Observe.*:*OutOfFocus*:PosteriorBound*:*Reports*'
long+=':RigWithoutFault*:RowsWithin*:StripedBackdrop*:*SubPixel*:TexturedBackdrop*:WhiteBalance*'
harness='*Alignment*:*EveryFilter*:*EveryFormat*:*Errors*:Evaluation.*:FormatRegistry*:ParseFilters*:Report*:ReferencePages*'
harness+=':RunResult*:*Score*:SeedResult*:*Summar*:*Trajectory*-*Command*:Dataset.*:*Detector*:*Gates*:QuietOption*:RunOutput*'
{
  printf '%s\n' slam vision worlds | sed "s/.*/build\/release\/tests\/&_tests --gtest_filter=-$long/"
  echo "build/release/tests/harness_tests --gtest_filter=$harness"
} | xargs -P "$(nproc)" -I {} sh -c 'set -f; {} --gtest_brief=1'
