#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# What a build from nothing costs, and its longest steps: the program of the release preset, or file by file as the dev
# preset has it, or the suite beside the program. No cache is used.
# Usage: bash tests/bench/build_time.sh [release|files|suite]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
way=${1:-release}
case $way in
  release) options=() target=faultline ;;
  files) options=(-DCMAKE_UNITY_BUILD=OFF -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON) target=faultline ;;
  suite) options=(-DFAULTLINE_PYTHON=OFF) target=faultline_tests ;;
  *) echo "build_time: $way is unknown; release, files or suite" >&2 && exit 2 ;;
esac
build=$(mktemp -d)
trap 'rm -rf "$build"' EXIT
export CCACHE_DISABLE=1
cmake --preset release -B "$build" "${options[@]}" >/dev/null
begin=$(date +%s)
TIMEFORMAT='%U %S'
cpu=$({ time cmake --build "$build" --parallel "$(nproc)" --target "$target" >/dev/null; } 2>&1)
echo "$way: $(($(date +%s) - begin)) s on $(nproc) cores, processor time (user, system) $cpu s," \
  "$(($(grep -vc '^#' "$build/.ninja_log"))) steps"
grep -v '^#' "$build/.ninja_log" | awk '{printf "%7.1f s  %s\n", ($2 - $1) / 1000, $4}' | sort -rn | uniq | head -12
