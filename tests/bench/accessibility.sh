#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Checks report, identification, inspection, comparison and batch pages of the sample logs with axe-core, by the rules of WCAG 2 levels A
# and AA, in Chromium at 320 to 2560 px, light and dark. axe-core is not part of the project: the caller names its axe.min.js.
# Usage: AXE=path/to/axe.min.js [BUILD=build/release] bash tests/bench/accessibility.sh [PAGE.html...]
set -euo pipefail
if [ ! -f "${AXE:-}" ]; then
  echo "accessibility: set AXE to the axe.min.js of axe-core, such as AXE=node_modules/axe-core/axe.min.js" >&2
  exit 2
fi
AXE=$(realpath "$AXE")
pages=()
for page in "$@"; do pages+=("$(realpath "$page")"); done
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
build=${BUILD:-build/release}
cmake --build "$build" --target faultline faultline_open_report >/dev/null
samples=sample_logs
if [ ${#pages[@]} -eq 0 ]; then
  out=out/accessibility
  mkdir -p "$out"
  model=$(echo "$samples"/golden/model-*.json) cases=$(echo "$samples"/golden/cases-*.db)
  for log in "$samples"/golden/logs/*.csv; do
    page=$out/$(basename "$log" .csv).html
    "$build/faultline" diagnose "$log" --model "$model" --cases "$cases" --html "$page" >/dev/null || [ $? -eq 1 ]
    pages+=("$page")
  done
  robot=$samples/bench/robot.toml
  "$build/faultline" identify "$samples"/bench/healthy_*.csv --robot "$robot" -o "$out/identified.toml" \
    --html "$out/identify.html" >/dev/null
  "$build/faultline" inspect "$samples"/bench/stuck_encoder_3.csv "$samples"/bench/healthy_1.csv --robot "$robot" \
    --html "$out/inspect.html" >/dev/null || [ $? -eq 1 ]
  "$build/faultline" compare "$samples"/bench/healthy_2.csv "$samples"/bench/torque_loss_1.csv --model "$model" \
    --html "$out/compare.html" >/dev/null || [ $? -eq 1 ]
  rm -rf "$out/batch"
  "$build/faultline" batch "$samples/golden/logs" "$samples/bench" --model "$model" --cases "$cases" -o "$out/batch" \
    --identify >/dev/null 2>&1 || [ $? -eq 1 ]
  pages+=("$out/identify.html" "$out/inspect.html" "$out/compare.html" "$out/batch/index.html")
fi
status=0
for page in "${pages[@]}"; do "$build/tests/faultline_open_report" "$page" --axe "$AXE" || status=1; done
exit $status
