#!/bin/bash
# Breaks each rule once in a small repository of its own and expects the check to turn red, and green before.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT

clean_repository() {
  rm -rf "$place/repo" && mkdir -p "$place/repo" && cd "$place/repo"
  git init -q
  mkdir -p slam vision harness scripts docs/guide
  cp "$here/../../.clang-format" .
  printf '/build/\n/out/\n' >.gitignore
  printf '#include "slam/b.h"\n\nint one();\n' >slam/a.h
  printf 'int two();\n' >slam/b.h
  printf '#include "slam/a.h"\n#include "vision/b.h"\n' >harness/c.cpp
  printf '#!/bin/bash\n' >scripts/demo.sh && chmod +x scripts/demo.sh
  printf '```sh\nscripts/demo.sh\n$ stereobench run a \\\n    --out out/b  # comment\n```\n```text\nfoo\n```\n' >README.md
  printf '# First Steps\n\n```sh\nstereobench run a --out out/b\n```\n' >docs/guide/first.md
  printf '\n[one](docs/guide/first.md#first-steps), [two](slam/), `[0](x)`\n| %0200d |\n\n    %0200d\n' 0 0 >>README.md
}

failures=0
expect() { # expect red|green RULE: what was done
  local wanted=$1 rule=$2 seen=green
  git add -A -f
  if [ "$rule" = readme ]; then
    bash "$here/readme_commands.sh" . "$place/program" >"$place/log" 2>&1 || seen=red
  else
    bash "$here/check.sh" "$rule" . >"$place/log" 2>&1 || seen=red
  fi
  [ "$seen" = "$wanted" ] && return
  echo "$rule is $seen, expected $wanted: $3"
  sed 's/^/    /' "$place/log"
  failures=1
}

# A program that works once in a folder, when it is given `run a --out out/b`.
printf '#!/bin/bash\n[ "$*" = "run a --out out/b" ] && mkdir done\n' >"$place/program" && chmod +x "$place/program"

clean_repository
for rule in format layers arithmetic sizes products documents readme; do expect green "$rule" "a clean repository"; done

clean_repository && printf 'int  one( );\n' >slam/a.h && expect red format "two blanks"
clean_repository && printf '#include "slam/b.h"\n#include "slam/a.h"\n' >vision/a.cpp && expect red format "unsorted includes"

clean_repository && printf '#include "vision/a.h"\n' >slam/a.cpp && expect red layers "slam includes vision"
clean_repository && printf '#  include "harness/a.h"\n' >vision/a.h && expect red layers "vision includes harness"
clean_repository && printf '#include "a.h"\n' >slam/a.cpp && expect red layers "a path that does not begin at the root"
clean_repository && printf '#include <opencv2/core.hpp>\n' >slam/a.cpp && expect red layers "an image in slam"
clean_repository && mkdir slam/x slam/y && printf '#include "slam/y/b.h"\n' >slam/x/a.h &&
  printf '#include "slam/x/c.h"\n' >slam/y/b.h && touch slam/x/c.h && expect red layers "two rooms in a circle"
clean_repository && mkdir slam/x && printf '#include "slam/x/b.h"\n' >slam/x/a.h && touch slam/x/b.h &&
  expect green layers "a room that includes itself"

clean_repository && printf 'struct One {\n};\n' | tee slam/a.h >slam/b.h && expect red layers "one type in two headers"

clean_repository && printf 'double a = std::sin(1.0);\n' >slam/a.cpp && expect red arithmetic "a sine of the C library"
clean_repository && git add -A -f && printf 'double a = std::sin(1.0);\n' >slam/new.cpp &&
  bash "$here/check.sh" arithmetic . >/dev/null && { echo "a new file is not looked at"; failures=1; }
clean_repository && printf 'double a = std::sqrt(1.0);\n' >slam/a.cpp && expect green arithmetic "a root, which is exact"

clean_repository && seq 351 | sed 's/^/\/\/ /' >slam/a.h && expect red sizes "351 lines"
clean_repository && seq 350 | sed 's/^/\/\/ /' >slam/a.h && expect green sizes "350 lines"
clean_repository && for i in {1..24}; do touch "slam/file$i.cpp"; done && expect red sizes "26 sources in a folder"

clean_repository && mkdir build && touch build/a && expect red products "a tracked file in build"
clean_repository && printf '\x7fELF\x02\x01' >slam/tool && expect red products "a tracked program"
clean_repository && printf '/build/\n' >.gitignore && expect red products "out is not ignored"

clean_repository && printf '%0161d\n' 0 >>README.md && expect red documents "a line of 161 characters"
clean_repository && sed -i 's/first.md#/last.md#/' README.md && expect red documents "a link to no file"
clean_repository && sed -i 's/^# First/# Other/' docs/guide/first.md && expect red documents "a link to no heading"
clean_repository && printf '[one](#two)\n' >>docs/guide/first.md && expect red documents "the same on its own page"
clean_repository && printf '[one](first.md)\n' >>docs/guide/first.md && expect green documents "a link from a folder"
clean_repository && printf '// see docs/lost.md\n' >>slam/b.h && expect red documents "a text that names a lost document"

clean_repository && rm scripts/demo.sh && expect red readme "a script that does not exist"
clean_repository && sed -i 's/run a/run c/' README.md && expect red readme "a command that fails"
clean_repository && sed -i 's/^scripts\/demo.sh/frobnicate/' README.md && expect red readme "a command nobody checks"
clean_repository && sed -i 's/run a/run c/' docs/guide/first.md && expect red readme "a command of the guide that fails"
clean_repository && sed -i 's/^stereobench/frobnicate/' docs/guide/first.md && expect red readme "one nobody checks"
if /usr/bin/python3 -c 'import cv2, numpy' 2>/dev/null; then
  python_page() { # a page whose last block of Python is $1
    clean_repository && mkdir -p harness/python/stereobench && touch harness/python/stereobench/__init__.py
    printf '```python\nfrom stereobench import __file__\nx = 1\n```\n\n```python\n%s\n```\n' "$1" >>docs/guide/first.md
  }
  python_page 'import os; assert x == 1 and os.path.isdir("done")' && expect green readme "Python after the commands"
  python_page 'assert x == 2' && expect red readme "Python of the guide that fails"
fi
clean_repository && rm -r docs && expect green readme "no guide"
clean_repository && rm README.md && expect red readme "no README"
clean_repository && printf 'text\n' >README.md && expect red readme "no commands"
exit $failures
