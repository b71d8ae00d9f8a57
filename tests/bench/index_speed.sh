#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# How long the index of a batch takes to open, filter, sort and zoom in Chromium: 100 to 100 000 logs, as wide
# as a screen and as a phone. The target: 100 000 logs open in 1 s and filter in 0.1 s.
# Usage: bash tests/bench/index_speed.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
cmake --build --preset release --target faultline_index_speed >/dev/null
for logs in 100 1000 10000 100000; do
  for width in 390 1280; do build/release/tests/faultline_index_speed "out/index-speed/$logs" "$logs" "$width"; done
done
