#!/bin/bash
# Feeds what reads files from anywhere (pictures, calibrations, detections, palettes, scenarios, logs, trajectories,
# marks, meshes, results, suites, baselines, recordings, archives, truth, lists of files) with mutated inputs of up to a
# megabyte under the sanitizers, by clang's libFuzzer. What it finds is left in build/fuzz/findings, with exit code 1.
# usage: scripts/fuzz.sh [MINUTES in all, default 10]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

command -v clang++-14 >/dev/null || { echo "clang++-14 is missing: apt-get install clang-14 libclang-rt-14-dev" >&2; exit 2; }
cmake --preset fuzz -Wno-dev >/dev/null
cmake --build --preset fuzz --target stereobench_fuzz
program=$PWD/build/fuzz/tests/stereobench_fuzz
entries=(scene picture calibration detections palette scenario log trajectory poses marks mesh
  result suite baseline bag mcap shards tiff drive manifest collection)
seconds=$((${1:-10} * 60 / ${#entries[@]}))
mkdir -p build/fuzz/findings

status=0
for entry in "${entries[@]}"; do
  corpus=build/fuzz/corpus/$entry
  mkdir -p "$corpus"
  export STEREOBENCH_FUZZ=$entry
  "$program" --seeds "$corpus"
  echo "$entry: $seconds s"
  "$program" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -max_len=1048576 -verbosity=0 \
    -print_final_stats=1 -artifact_prefix="build/fuzz/findings/$entry." "$corpus" || status=1
done
exit $status
