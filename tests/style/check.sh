#!/bin/bash
# Checks one rule of the house on the files that git tracks, and on new ones that it does not ignore.
# usage: check.sh format|layers|arithmetic|sizes|products|documents [ROOT]
# Prints each breach and exits 1 when there is one; exits 77 (skipped) where there is no git checkout.
set -euo pipefail
rule=$1
cd "${2:-$(dirname "${BASH_SOURCE[0]}")/../..}"

# The checkout may belong to somebody else, as in a container.
git() { command git -c safe.directory='*' "$@"; }
git ls-files --error-unmatch . >/dev/null 2>&1 || { echo "not a git checkout: skipped"; exit 77; }

tracked() { # and new files that git does not ignore; those that are there: a file may have been deleted
  git ls-files --cached --others --exclude-standard -- "$@" | while read -r file; do [ -f "$file" ] && echo "$file"; done
}

breaches=0
breach() {
  echo "$1"
  breaches=1
}

# C++ looks as clang-format 14 writes it; that includes the order of includes.
check_format() {
  local sources
  mapfile -t sources < <(tracked '*.cpp' '*.h')
  [ ${#sources[@]} -eq 0 ] || clang-format-14 --dry-run -Werror "${sources[@]}" || breach "run clang-format-14 -i on them"
}

# A module includes itself and those to its left; what is above the chain (tests) may include all.
check_layers() {
  local file own included
  local -A rank=([slam]=1 [vision]=2 [worlds]=3 [renderer]=4 [harness]=5)
  while IFS=: read -r file included; do
    own=${file%%/*}
    if [ -z "${rank[$included]:-}" ]; then
      breach "$file: includes \"$included...\"; paths begin with the name of a module"
    elif [ "${rank[$included]}" -gt "${rank[$own]}" ]; then
      breach "$file: $own may not include $included, which is to its right"
    fi
  done < <(tracked 'slam/*' 'vision/*' 'worlds/*' 'renderer/*' 'harness/*' |
    xargs -r grep -H -o -E '^ *# *include *"[^"/]*' | sed -E 's/:[^:]*"/:/')
  while read -r file; do
    breach "$file: slam has never heard of an image"
  done < <(tracked 'slam/*' | xargs -r grep -l -E '# *include *<opencv' || true)
  check_rooms
  check_types
}

# Two types of one name and namespace are one type to the linker, which takes the destructor of either.
check_types() {
  local module type
  for module in slam vision worlds renderer harness; do
    while read -r type; do
      breach "$module: more than one header defines $type"
    done < <(tracked "$module/*.h" | xargs -r grep -h -o -E '^(struct|class|enum class) [A-Z][A-Za-z0-9]*( final)?( : [^;{]*)? \{' |
      sed -E 's/^(struct|class|enum class) ([A-Za-z0-9]*).*/\2/' | sort | uniq -d)
  done
}

# Rooms are the folders within a module; a file beside them is a room of its own. None includes itself by way of others.
check_rooms() {
  local circle
  while read -r circle; do
    breach "rooms include each other in a circle:$circle"
  done < <(tracked 'slam/*' 'vision/*' 'worlds/*' 'renderer/*' 'harness/*' |
    xargs -r grep -H -o -E '^ *# *include *"[^"]*"' |
    sed -E 's/: *# *include *"/ /; s/"$//; s/\.(h|cpp)( |$)/\2/g; s#([^ /]+/[^ /]+)/[^ ]*#\1#g' |
    sort -u | tsort 2>&1 >/dev/null | sed -n '/loop/d; s/^tsort:/ /p' | tr -d '\n' | sed 's/$/\n/')
}

# What results are made of has the same bits on every processor: slam/math/elementary.h in place of the C library, whose
# kernels differ by what the processor can do.
check_arithmetic() {
  local place
  while read -r place; do
    breach "$place: use doubles (roots of floats in packets begin with the processor's own estimate)"
  done < <(tracked 'slam/*' 'vision/*' 'worlds/*' 'harness/*' | xargs -r grep -H -n -o -E 'Eigen::Array(<float|[234X]+f)' || true)
  while read -r place; do
    breach "$place: use slam/math/elementary.h (for hypot, a norm)"
  done < <(tracked 'slam/*' 'vision/*' 'worlds/*' 'harness/*' \
    ':!harness/commands/*' ':!harness/report/*' ':!harness/rig_calibration/*' ':!harness/io/text_table.cpp' |
    xargs -r grep -H -n -o -E 'std::(a?(sin|cos|tan)h?|atan2|exp2?|expm1|log(2|10|1p)?|pow|hypot|cbrt|erfc?|[lt]gamma)\(' || true)
}

# A file can be read at one sitting, and so can the list of files in a folder.
check_sizes() {
  local file lines
  while read -r lines file; do
    [ "$file" = total ] || [ "$lines" -le 350 ] || breach "$file: $lines lines, 350 are allowed"
  done < <(tracked '*.cpp' '*.h' '*.sh' '*.cmake' '*CMakeLists.txt' | xargs -r wc -l)
  while read -r lines file; do
    [ "$lines" -le 25 ] || breach "$file: $lines sources, 25 are allowed"
  done < <(tracked '*.cpp' '*.h' | sed -E 's#/[^/]*$##' | sort | uniq -c)
}

# What is built or measured stays out of the history.
check_products() {
  local file
  while read -r file; do
    case "$file" in
      build/* | out/* | *.o | *.a | *.so | *.gcda | *.gcno | *.pyc | *CMakeCache.txt | *.ninja | core)
        breach "$file: is a product of the build or of a run" ;;
    esac
  done < <(tracked)
  while read -r file; do
    breach "$file: is a program"
  done < <(tracked | LC_ALL=C xargs -r -d '\n' grep -l -a -z -P '\A\x7fELF' || true)
  for file in build/x out/x; do
    git check-ignore -q --no-index "$file" || breach ".gitignore: does not ignore ${file%x}"
  done
}

# The anchors of a document's headings, as GitHub makes them.
anchors() {
  sed -n -E '/^ *```/,/^ *```/d; s/^#+ +//p' "$1" | tr '[:upper:]' '[:lower:]' | sed -E 's/[^a-z0-9 _-]//g; s/ /-/g'
}

# Where the links of a document lead. Code and pictures of other sites are left out.
links() {
  sed -E '/^ *```/,/^ *```/d; s/`[^`]*`//g' "$1" | grep -o -E '\]\([^) ]+\)' | sed -E 's/^\]\(|\)$//g' |
    grep -v -E '^[a-z]+:' || true
}

check_links() {
  local file=$1 link target
  while read -r link; do
    target=${link%%#*}
    target=${target:+$(dirname "$file")/$target}
    target=${target:-$file}
    if [ ! -e "$target" ]; then
      breach "$file: leads nowhere: $link"
    elif [[ $link == *'#'* ]] && ! anchors "$target" | grep -q -x -F -- "${link#*#}"; then
      breach "$file: no such heading: $link"
    fi
  done < <(links "$file")
}

# Documents can be read in any editor, and lead where they say; so do texts that name a document. Tables and code
# may be wider.
check_documents() {
  local file place
  while read -r file; do
    while read -r place; do
      breach "$file:$place: wider than 160 characters; wrap at 120"
    done < <(awk '/^ *```/ { code = !code } !code && !/^(\||    )/ && length > 160 { print NR }' "$file")
    check_links "$file"
  done < <(tracked '*.md')
  while IFS=: read -r file place; do
    [ -f "$place" ] || breach "$file: names a document that does not exist: $place"
  done < <(tracked . ':!tests/style/self_test.sh' | xargs -r -d '\n' grep -H -I -o -E '\bdocs/[a-z_/]+\.md\b' | sort -u)
}

"check_$rule"
exit $breaches
