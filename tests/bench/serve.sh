#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Pages of faultline serve: 200 uploads of two users during 20 kills, then the time of a page, and that of upload,
# diagnosis and report of two simulated logs of 5 000 rows, one healthy, one with a locked joint.
# Usage: bash tests/bench/serve.sh [UPLOADS KILLS]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
program=$(realpath "$FAULTLINE")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$program" learn sample_logs/bench/healthy_*.csv --robot sample_logs/bench/robot.toml -o "$work/bench.model" \
  >/dev/null 2>&1
sed '/^\[\[run\]\]/,$d' sample_logs/bench/spec.toml >"$work/spec.toml"
printf '[[run]]\nname = "locked"\nduration_s = 365.0\nfault = {kind = "locked", joint = 1, onset_s = 200.0}\n' >>"$work/spec.toml"
printf '[[run]]\nname = "healthy"\nduration_s = 365.0\n' >>"$work/spec.toml"
"$program" simulate "$work/spec.toml" -o "$work/long" >/dev/null
python3 tests/bench/serve.py "$program" "$work/bench.model" sample_logs/bench/locked_1.csv "${1:-200}" "${2:-20}" \
  "$work"/long/{healthy,locked}.csv
