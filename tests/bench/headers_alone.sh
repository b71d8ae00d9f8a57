#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Compiles every header of lib/ and formats/ alone, as one who includes only it; some minutes on two cores. Prints those
# that do not compile. Usage: bash tests/bench/headers_alone.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

compile() {
  c++ -std=c++20 -fsyntax-only -w -I. -isystem /usr/include/eigen3 $(pkg-config --cflags hdf5) -DTOML_HEADER_ONLY=0 -DTOML_SHARED_LIB=1 -x c++ "$1" ||
    echo "does not compile alone: $1"
}
export -f compile
mapfile -t headers < <(find lib formats -name '*.hpp' | sort)
failed=$(printf '%s\n' "${headers[@]}" | xargs -P "$(nproc)" -I{} bash -c 'compile {} 2>/dev/null')
[ -z "$failed" ] && echo "${#headers[@]} headers compile alone" || { echo "$failed"; exit 1; }
