#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# A study on logs of our own simulator with seeds and controllers that nothing was tuned on: the specs in
# tests/bench/own are simulated, a model is learned from each one's healthy logs alone, and diagnoses all its logs.
# Usage: bash tests/bench/own_simulation.sh [GROUP...]    GROUP is a spec's name
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
out=out/own-simulation
. tests/bench/study.sh

# group, l1 in m, what the torque does between samples
groups="\
industrial 0.45 held
light 0.28 unknown
bench_100hz 1.0 held
bench_73ms 1.0 held"

chosen=()
while read -r group l1 between; do
  [ $# -eq 0 ] || [[ " $* " == *" $group "* ]] || continue
  dir=$out/$group
  rm -rf "$dir" && mkdir -p "$dir/logs"
  "$faultline" simulate "tests/bench/own/$group.toml" -o "$dir/logs" >"$dir/simulate.txt"
  cp "$dir/logs/labels.csv" "$dir/labels.csv"
  printf 'axes = "RRP"\n\n[known]\nl1 = %s\n\n[log]\ntorque = "commanded"\ntorque_between_samples = "%s"\n' \
    "$l1" "$between" >"$dir/robot.toml"
  study_group "$dir" "$dir/logs"
  chosen+=("$dir")
done <<<"$groups"
python3 tests/bench/score.py "${chosen[@]}"
