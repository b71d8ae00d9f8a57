#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Logs whose clock restarts, whose values end, and whose rows are lost: each faulty sample log altered in these three
# ways before its fault shows, and each healthy one likewise. Prints how many verdicts are "healthy" with a fault
# behind the damage (none should be), and in how many healthy logs a fault is named. Learns a model of each sample
# robot unless there is one.
# Usage: bash tests/bench/missing_and_restarting.sh [SEED]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
source tests/bench/need_program.sh
out=$FAULTLINE_OUT/missing_and_restarting
mkdir -p "$out"
for robot in bench industrial rrpr; do
  samples=sample_logs/$robot
  [ -e "$out/$robot.json" ] || "$FAULTLINE" learn $samples/healthy_* --robot $samples/robot.toml \
    -o "$out/$robot.json" >"$out/$robot.txt"
done
exec "${PYTHON:-python3}" tests/bench/missing_and_restarting.py "$FAULTLINE" "$out" "$@"
