#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# clang-tidy (Debian package clang-tidy) over the sources, by hand: some 20 minutes on two cores.
# Usage: bash tests/tidy.sh [REGEX]     REGEX chooses files by their path, such as lib/explain
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

[ -f build/release/compile_commands.json ] || cmake --preset release >&2
run-clang-tidy -quiet -p build/release "${1:-/(lib|formats|apps)/}" 2>/dev/null
