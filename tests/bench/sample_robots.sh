#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# The three sample robots: learned from their healthy logs with what a user would know of them, then every sample log
# is diagnosed. Beside it what learning measured of itself on simulated runs.
# Usage: bash tests/bench/sample_robots.sh [bench|industrial|rrpr]...
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
out=${FAULTLINE_OUT:-out}/sample-robots
. tests/bench/study.sh

chosen=()
for robot in bench industrial rrpr; do
  [ $# -eq 0 ] || [[ " $* " == *" $robot "* ]] || continue
  rm -rf "${out:?}/$robot" && mkdir -p "$out/$robot"
  cp "sample_logs/$robot/robot.toml" "sample_logs/$robot/labels.csv" "$out/$robot/"
  study_group "$out/$robot" "sample_logs/$robot"
  chosen+=("$out/$robot")
done
python3 tests/bench/sample_robots.py "${chosen[@]}"
