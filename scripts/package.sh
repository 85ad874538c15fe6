#!/bin/bash
# Makes the Debian packages stereobench, libstereobench-dev and python3-stereobench.
# usage: scripts/package.sh [FOLDER, default build/packages]
# Builds the program with the preset release. The same sources give the same bytes: dates in packages are that of
# packaging/changelog, unless SOURCE_DATE_EPOCH says another.
set -euo pipefail
folder=$(realpath -m "${1:-$(dirname "${BASH_SOURCE[0]}")/../build/packages}")
cd "$(dirname "${BASH_SOURCE[0]}")/.."

for program in help2man dpkg-shlibdeps file; do
  command -v $program >/dev/null ||
    { echo "package.sh: $program is missing: apt-get install help2man dpkg-dev file" >&2; exit 2; }
done
[ -d build/release ] || cmake --preset release -Wno-dev >/dev/null
cmake --build --preset release --target stereobench stereobench_python
export SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(date --date "$(sed -n 's/^ -- .*>  //p;T;q' packaging/changelog)" +%s)}
umask 022  # of folders in packages
mkdir -p "$folder"
cpack --config build/release/CPackConfig.cmake -B "$folder" >/dev/null
rm -rf "$folder/_CPack_Packages"
ls "$folder"/*.deb
