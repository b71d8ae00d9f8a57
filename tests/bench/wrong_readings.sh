#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Sample logs of three robots whose columns mean something else than the robot file says (degrees, mA, swapped columns,
# late torque and more): what is said of them. Learns the three robots first.
# Usage: bash tests/bench/wrong_readings.sh
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. tests/bench/need_program.sh
out=$FAULTLINE_OUT/wrong-readings
mkdir -p "$out"
models=()
for robot in bench industrial rrpr; do
  [ -e "$out/$robot.json" ] || "$FAULTLINE" learn sample_logs/"$robot"/healthy_* --robot "sample_logs/$robot/robot.toml" \
    -o "$out/$robot.json" >"$out/$robot.txt"
  models+=("$robot=$out/$robot.json")
done
python3 tests/bench/wrong_readings.py "$FAULTLINE" "$out" "${models[@]}"
