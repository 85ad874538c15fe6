#!/bin/bash
# Runs the commands of a README: what it tells people to type must work.
# usage: readme_commands.sh ROOT PROGRAM
# Takes the lines of ```sh blocks in ROOT/README.md. `stereobench ...` is run with PROGRAM, in order, in a temporary
# folder that has ROOT's assets; `scripts/...` and `.ci/run` install and build, so they must only exist and be
# executable. Any other command than those listed below is a breach: it would not be checked.
set -euo pipefail
root=$(cd "$1" && pwd)
program=$2
[ -f "$root/README.md" ] || { echo "README.md: missing"; exit 1; }

place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
for entry in "$root"/*; do
  case "${entry##*/}" in out | build) ;; *) ln -s "$entry" "$place/" ;; esac
done
cd "$place"

commands() { # one a line: continued lines joined, prompts, comments and blank lines left out
  awk '/^ *```/ { inside = !inside && $0 ~ /^ *```sh *$/; next } inside' "$root/README.md" |
    sed -e ':join' -e '/\\$/{N;s/\\\n */ /;b join' -e '}' -e 's/^ *\$ //' -e 's/ #.*//' -e '/^ *#/d' -e '/^ *$/d'
}

count=0
breaches=0
while IFS= read -r command; do
  count=$((count + 1))
  read -r first arguments <<<"$command"
  case "$first" in
    stereobench | build/release/harness/stereobench)
      echo "+ $command"
      bash -euc "\"\$0\" $arguments" "$program" </dev/null || { echo "README.md: failed: $command"; breaches=1; } ;;
    scripts/* | .ci/run | ./scripts/*)
      [ -x "$root/$first" ] || { echo "README.md: no such program: $first"; breaches=1; } ;;
    git | cd | cmake | ctest | sudo | apt-get | export | ls | cat) ;;
    *) echo "README.md: not checked by tests/style/readme_commands.sh: $command"; breaches=1 ;;
  esac
done < <(commands)
[ "$count" -gt 0 ] || { echo "README.md: no command in a \`\`\`sh block"; breaches=1; }
exit $breaches
