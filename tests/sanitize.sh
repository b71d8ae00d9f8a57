#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The whole suite under AddressSanitizer and UndefinedBehaviorSanitizer, by hand: on two cores some 25 minutes of
# building and an hour of tests.
# Usage: bash tests/sanitize.sh [OPTION of ctest...]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash apps/install.sh --tests
cmake --preset sanitize
cmake --build --preset sanitize --parallel "$(nproc)"
ctest --preset sanitize --parallel "$(nproc)" --timeout 3000 "$@"
