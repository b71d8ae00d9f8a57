#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The whole suite under AddressSanitizer and UndefinedBehaviorSanitizer, by hand: on two cores some 45 minutes of
# building and two hours of tests.
# Usage: bash tests/sanitize.sh [OPTION of ctest...]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash apps/install.sh --tests
cmake --preset sanitize
cmake --build --preset sanitize --parallel "$(nproc)"
export LSAN_OPTIONS="suppressions=$PWD/tests/fuzz/leaks_of_libraries.txt"
ctest --preset sanitize --parallel "$(nproc)" --timeout 3000 "$@"
