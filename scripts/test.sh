#!/bin/bash
# Installs what is missing, builds everything and runs every test.
# usage: scripts/test.sh [dev|release|clang|asan|asan_scopes] [options of ctest, e.g. -L style]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=release
case "${1:-}" in dev | release | clang | asan | asan_scopes) preset=$1; shift ;; esac

scripts/install_packages.sh
cmake --preset "$preset" -Wno-dev >/dev/null
cmake --build --preset "$preset"
ctest --preset "$preset" "$@"
