#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Healthy logs of three robots that a recorder, a converter or a configuration altered (wrapped angles, frozen columns,
# rows cut out, units that change and more): in how many a fault of the robot is named. Learns the three robots first.
# Usage: bash tests/bench/log_at_fault.sh [SEED] [ALTERATION...]
#   SEED of the places and of the healthy logs, 1 by default; ALTERATION: only those, by their number
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
. tests/bench/need_program.sh
out=$FAULTLINE_OUT/log-at-fault
mkdir -p "$out"
for robot in bench industrial rrpr; do
  [ -e "$out/$robot.json" ] || "$FAULTLINE" learn sample_logs/"$robot"/healthy_* --robot "sample_logs/$robot/robot.toml" \
    -o "$out/$robot.json" >"$out/$robot.txt"
done
exec "${PYTHON:-python3}" tests/bench/log_at_fault.py "$FAULTLINE" "$out" "$@"
