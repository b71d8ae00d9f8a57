#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Processor and wall time and memory of `faultline identify` on simulated arms of three and six axes and on an
# hour at 1 kHz. Usage: [FAULTLINE=program] bash tests/bench/identify_speed.sh [scara_1khz|spatial_3|spatial_6|hour_1khz ...]
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
program="$(realpath "${FAULTLINE:-$here/../../build/release/faultline}")"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
declare -A robot=([scara_1khz]=scara [spatial_3]=arm_3 [spatial_6]=arm_6 [hour_1khz]=scara)
declare -A goal=([scara_1khz]="5 s" [spatial_3]="5 s" [spatial_6]="20 s" [hour_1khz]="60 s, 500 MB")
cases=("$@")
[ ${#cases[@]} -gt 0 ] || cases=(scara_1khz spatial_3 spatial_6 hour_1khz)
echo "| logs | wall, s | processor, s | memory, MB | goal, wall | result |"
echo "|---|---|---|---|---|---|"
for name in "${cases[@]}"; do
  "$program" simulate "$here/speed/$name.toml" -o "$work/$name" > "$work/simulate.txt"
  rm -f "$work/$name/labels.csv"
  python3 "$here/measured_run.py" "$work/usage" "$program" identify "$work/$name"/healthy_* \
    --robot "$here/speed/${robot[$name]}.toml" -o "$work/identified.toml" > "$work/out.txt" 2> "$work/err.txt" ||
    { cat "$work/err.txt" >&2; exit 1; }
  read -r wall processor memory < "$work/usage"
  echo "| $name | $wall | $processor | $memory | ${goal[$name]} | $(head -1 "$work/out.txt") |"
done
