#!/bin/bash
# Installs those packages of scripts/packages.txt that are missing; does nothing when none is.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

missing=()
for package in $(sed 's/#.*//' "$here/packages.txt"); do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  # Several architectures of a package are several words.
  case "$status" in *not-installed* | *config-files* | *half* | *unpacked* | '') missing+=("$package") ;; esac
done
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "install_packages.sh: neither root nor sudo; as root run: apt-get install ${missing[*]}" >&2
    exit 2
  fi
  as_root=(sudo)
fi
install=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends "${missing[@]}")

echo "installing ${#missing[@]} Debian packages: ${missing[*]}"
# The package lists may be absent (a bare system) or older than the mirror: only then are they fetched.
if ! "${install[@]}" -qq >/dev/null 2>&1; then
  "${as_root[@]}" apt-get update -qq
  "${install[@]}" -qq >/dev/null
fi
