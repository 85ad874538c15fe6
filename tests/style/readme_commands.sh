#!/bin/bash
# Runs the commands of the README and of the guide: what they tell people to type must work.
# usage: readme_commands.sh ROOT PROGRAM
# Takes the lines of ```sh blocks in ROOT/README.md and ROOT/docs/guide/*.md. `stereobench ...` is run with PROGRAM, in
# order, in a temporary folder that has ROOT's assets: a new one for each document, so that a page works by itself.
# `scripts/...` and `.ci/run` install and build, so they must only exist and be executable. Any other command than those
# listed below is a breach: it would not be checked.
# The ```python blocks of a page that imports `stereobench` are one script, which runs after its commands in the same
# folder. Without Debian's python3-opencv it does not, nor without the compiled part of the package where it needs that.
set -euo pipefail
root=$(cd "$1" && pwd)
program=$2
[ -f "$root/README.md" ] || { echo "README.md: missing"; exit 1; }

place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
breaches=0
breach() {
  echo "$document: $1"
  breaches=1
}

fresh_folder() {
  rm -rf "$place/here" && mkdir "$place/here" && cd "$place/here"
  local entry
  for entry in "$root"/*; do
    case "${entry##*/}" in out | build) ;; *) ln -s "$entry" . ;; esac
  done
}

commands() { # one a line: continued lines joined, prompts, comments and blank lines left out
  awk '/^ *```/ { inside = !inside && $0 ~ /^ *```sh *$/; next } inside' "$root/$document" |
    sed -e ':join' -e '/\\$/{N;s/\\\n */ /;b join' -e '}' -e 's/^ *\$ //' -e 's/ #.*//' -e '/^ *#/d' -e '/^ *$/d'
}

try() {
  local command=$1 first arguments
  read -r first arguments <<<"$command"
  case "$first" in
    stereobench | build/release/harness/stereobench)
      echo "+ $command"
      bash -euc "\"\$0\" $arguments" "$program" </dev/null || breach "failed: $command" ;;
    scripts/* | .ci/run | ./scripts/*)
      [ -x "$root/$first" ] || breach "no such program: $first" ;;
    git | cd | cmake | ctest | sudo | apt-get | export | ls | cat) ;;
    *) breach "not checked by tests/style/readme_commands.sh: $command" ;;
  esac
}

python_blocks() {
  awk '/^ *```/ { inside = !inside && $0 ~ /^ *```python *$/; next } inside' "$root/$document"
}

try_python() {
  grep -q -E '^(from|import) stereobench' <<<"$(python_blocks)" || return 0
  if ! /usr/bin/python3 -c 'import cv2, numpy' 2>/dev/null; then
    echo "$document: python blocks are not run without python3-opencv"
    return 0
  fi
  local package
  package=$(dirname "$(dirname "$program")")/python
  if grep -q '^import stereobench' <<<"$(python_blocks)" && ! ls "$package"/stereobench/_core*.so >/dev/null 2>&1; then
    echo "$document: python blocks are not run without the compiled part of the Python package"
    return 0
  fi
  echo "+ python blocks of $document"
  python_blocks | PYTHONDONTWRITEBYTECODE=1 PYTHONPATH="$package:$root/harness/python" /usr/bin/python3 - ||
    breach "its python blocks fail"
}

check() {
  document=$1
  local count=0 command
  fresh_folder
  while IFS= read -r command; do
    count=$((count + 1))
    try "$command"
  done < <(commands)
  try_python
  [ "$count" -gt 0 ] || [ "$document" != README.md ] || breach "no command in a \`\`\`sh block"
}

check README.md
for page in "$root"/docs/guide/*.md; do
  [ ! -f "$page" ] || check "docs/guide/${page##*/}"
done
exit $breaches
