#!/bin/bash
# From a fresh Debian 12 to the first result: installs what is missing, builds, and runs the circle of balls.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install_packages.sh
cmake --preset release -Wno-dev >/dev/null
cmake --build --preset release --target stereobench
out=out/ball_circle
build/release/harness/stereobench run assets/scenarios/ball_circle.yaml --out "$out"

echo
echo "pictures:"
find "$PWD/$out" -name '*.png' | sort | sed 's/^/  /'
echo "results:"
find "$PWD/$out" -name '*.json' -o -name '*.csv' -o -name '*.csv.gz' | sort | sed 's/^/  /'
