#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# How large HTML reports are, how long writing one takes and how long Chromium takes to open it: a run of ten
# minutes and one of an hour, at 1 kHz, with a fault each, as native and as CSV file.
# Usage: bash tests/bench/html_report.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
faultline=build/release/faultline
out=out/html-report
cmake --build --preset release --target faultline faultline_open_report >/dev/null
mkdir -p "$out"

robot=sample_logs/industrial
[ -f "$out/model.json" ] ||
  "$faultline" learn "$robot"/healthy_*.flog --robot "$robot/robot.toml" -o "$out/model.json" >/dev/null
if [ ! -f "$out/hour.csv" ]; then
  sed '/^\[\[run\]\]/,$d' "$robot/spec.toml" >"$out/spec.toml"
  for run in "ten_minutes 600 300" "hour 3600 3000"; do
    read -r name length onset <<<"$run"
    printf '[[run]]\nname = "%s"\nduration_s = %s\nfault = {kind = "friction_increase", joint = 2, onset_s = %s, size = 1.5}\n' \
      "$name" "$length" "$onset" >>"$out/spec.toml"
  done
  "$faultline" simulate "$out/spec.toml" -o "$out" >/dev/null
  for name in ten_minutes hour; do "$faultline" convert "$out/$name.flog" "$out/$name.csv" >/dev/null; done
fi

# Seconds of processor time that a command takes, the least of three; other work on the machine changes it little.
seconds() {
  local TIMEFORMAT='%U %S' best=1e9
  for _ in 1 2 3; do
    best=$({ time { "$@" >/dev/null || [ $? -eq 1 ]; }; } 2>&1 | awk -v b="$best" '{d = $1 + $2; print d < b ? d : b}')
  done
  echo "$best"
}

printf '%-18s %9s %12s %12s %10s   %s\n' log rows diagnose/s report/s size/kB "in Chromium"
for log in ten_minutes.flog ten_minutes.csv hour.flog hour.csv; do
  page=$out/$log.html
  alone=$(seconds "$faultline" diagnose "$out/$log" --model "$out/model.json" --json "$out/$log.json")
  both=$(seconds "$faultline" diagnose "$out/$log" --model "$out/model.json" --json "$out/$log.json" --html "$page")
  rows=$(grep -m1 -o '"rows": [0-9]*' "$out/$log.json" | grep -o '[0-9]*')
  opened=$(build/release/tests/faultline_open_report "$page" || true)
  awk -v l="$log" -v r="$rows" -v a="$alone" -v b="$both" -v s="$(stat -c %s "$page")" -v o="$opened" \
    'BEGIN {printf "%-18s %9d %12.2f %12.2f %10.0f   %s\n", l, r, a, b - a, s / 1000, o}'
done
