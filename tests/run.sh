#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Everything from a fresh Debian 12 to all tests: installs what is missing, builds Release, runs the tests.
# Usage: bash tests/run.sh [OPTION of cmake...]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash apps/install.sh --tests
# From here on a test that misses one of the packages fails; elsewhere than on Debian it is skipped.
if command -v apt-get >/dev/null; then
  export FAULTLINE_PACKAGES_INSTALLED=1
fi
cmake --preset release "$@"
cmake --build --preset release --parallel "$(nproc)"
ctest --preset release --parallel "$(nproc)"
