#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# clang-tidy (Debian package clang-tidy) over the sources, each by itself; a warning is an error.
# Usage: bash tests/tidy.sh [REGEX]            files whose path matches, such as lib/explain; all of lib, formats
#                                              and apps by default: some 40 minutes on two cores
#        bash tests/tidy.sh --changed COMMIT   files that changed since the commit (or its merge base with HEAD)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if ! command -v clang-tidy >/dev/null; then
  echo "tidy: there is no clang-tidy; install it (bash apps/install.sh --checks)" >&2
  exit 2
fi
if [ "${1:-}" = --changed ]; then
  base=$(git merge-base "${2:?tidy: --changed needs a commit}" HEAD 2>/dev/null) || base=HEAD~1
  mapfile -t changed < <(git diff --name-only --diff-filter=d "$base" -- 'lib/*' 'formats/*' 'apps/*')
  files=()
  for file in "${changed[@]}"; do
    source=${file%.hpp}
    source=${source%.cpp}.cpp
    case $file in *.?pp) [ -f "$source" ] && files+=("$source") ;; esac
  done
else
  mapfile -t files < <(git ls-files 'lib/*.cpp' 'formats/*.cpp' 'apps/*.cpp' | grep -E "${1:-.}")
fi
mapfile -t files < <(printf '%s\n' "${files[@]}" | sort -u)
if [ -z "${files[0]}" ]; then
  echo "tidy: no source to check" >&2
  exit 0
fi

cmake --preset dev -B build/tidy -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >&2
mapfile -t known < <(printf '%s\n' "${files[@]}" | while read -r file; do
  grep -qF "\"file\": \"$PWD/$file\"" build/tidy/compile_commands.json && echo "$file"
done)
echo "tidy: ${#known[@]} sources" >&2
[ ${#known[@]} -gt 0 ] || exit 0
printf '%s\0' "${known[@]}" |
  xargs -0 -P "$(nproc)" -n 1 clang-tidy --quiet -p build/tidy --extra-arg=-Wno-unknown-warning-option 2>/dev/null
echo "tidy: no warning" >&2
