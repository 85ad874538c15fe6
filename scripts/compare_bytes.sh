#!/bin/bash
# Compares what two builds of the program write, byte for byte: for a change that must change nothing.
# usage: scripts/compare_bytes.sh BEFORE AFTER    two paths of the program `stereobench`
# Runs, renders with all truth, replays, calibrates and sweeps shortened versions of the shipped scenarios with both,
# in some five minutes on two cores. Prints each file that differs; exits 1 when there is one.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
[ $# -eq 2 ] && [ -x "$1" ] && [ -x "$2" ] ||
  { echo "usage: scripts/compare_bytes.sh BEFORE AFTER (two executables)" >&2; exit 2; }
before=$(realpath "$1") after=$(realpath "$2")
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
scenarios=$PWD/assets/scenarios

# write_all PROGRAM FOLDER: what a user would get, and what is printed.
write_all() {
  local program=$1
  mkdir "$2" && cd "$2"
  stereobench() { # stereobench NAME ARGUMENTS...: gates may break in shortened runs
    local name=$1 status=0
    shift
    "$program" "$@" >"$name.out" 2>"$name.err" || status=$?
    echo "exit $status" >>"$name.out"
    [ "$status" -le 1 ] || { echo "$name: exit $status" >&2; cat "$name.err" >&2; exit 2; }
  }
  stereobench circle run "$scenarios/ball_circle.yaml" --seeds 0..2 --set path.laps=0.3 --out circle
  stereobench corridor run "$scenarios/corridor.yaml" --seeds 0 --particles 30 --out corridor
  stereobench office run "$scenarios/office.yaml" --seeds 0..1 --out office
  stereobench open_field run "$scenarios/open_field.yaml" --seeds 0..3 --out open_field
  stereobench room run "$scenarios/room.yaml" --seeds 0 --out room
  stereobench filters run "$scenarios/open_field.yaml" --seeds 0..1 --set draw_every=40 --out filters \
    --filters dead_reckoning,ekf,fastslam1,fastslam2,ufastslam,fastslam2_iterated,ufastslam_iterated,ufastslam_kim,fastslam2_block,ufastslam_block
  stereobench lens run "$scenarios/ball_circle.yaml" --seeds 0 --set path.laps=0.1 --set rig.distortion=[-0.1,0.02,0,0,0] \
    --out lens
  stereobench dataset render "$scenarios/ball_circle.yaml" --truth all --set path.laps=0.05 --out dataset
  stereobench meshes render "$scenarios/office.yaml" --truth all --seeds 0 --frames 0..2 --out meshes
  stereobench replay slam dataset --seeds 0..1 --out replay
  stereobench detect detect dataset --draw drawn --out detections.jsonl
  stereobench calibrate calibrate "$scenarios/ball_circle.yaml" --seeds 0..3 --out calibrate
  stereobench sweep sweep "$scenarios/ball_circle.yaml" --vary camera.noise_sd_levels=0,4 --set path.laps=0.1 \
    --seeds 0..1 --out sweep
  stereobench plan world "$scenarios/corridor.yaml" -o plan.svg
  stereobench schema schema -o schema.json
}

(write_all "$before" "$place/before") & other=$!
status=0
(write_all "$after" "$place/after") || status=$?
wait "$other" || status=$?
[ "$status" -eq 0 ] || exit 2
# Times differ from run to run, and where a command prints one the line names its seconds.
find "$place" \( -name timing.json -o -name invocation.json -o -name '*.err' \) -delete
sed -i -E '/ [0-9.]+ m?s\b.*(took|second|pair)|seconds/d' "$place"/*/*.out
if ! diff -rq "$place/before" "$place/after"; then
  [ -z "${KEEP:-}" ] || cp -r "$place" "$KEEP"
  exit 1
fi
echo "the same bytes in $(find "$place/after" -type f | wc -l) files"
